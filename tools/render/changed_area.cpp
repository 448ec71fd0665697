#include "tools/render/changed_area.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <string_view>

namespace gnbv {
namespace {

using Box2f = Eigen::AlignedBox2f;

template <std::size_t N>
std::uint64_t hash_of(const std::array<float, N>& numbers) {
  std::array<char, N * sizeof(float)> bytes;
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return std::hash<std::string_view>{}({bytes.data(), bytes.size()});
}

void add_triangles(const DrawLists& lists, const std::vector<std::uint32_t>& indices, float kind,
                   bool casts_shadow, std::vector<DrawnThing>& things) {
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    DrawnThing thing{.box_m = {}, .casts_shadow = casts_shadow};
    std::array<float, 31> numbers{kind};
    for (std::size_t k = 0; k < 3; ++k) {
      const DrawVertex& vertex = lists.vertices[indices[i + k]];
      thing.box_m.extend(vertex.p_world_m);
      auto* const to = numbers.data() + 1 + 10 * k;
      std::copy_n(vertex.p_world_m.data(), 3, to);
      std::copy_n(vertex.n_world.data(), 3, to + 3);
      std::copy_n(vertex.rgba.data(), 4, to + 6);
    }
    thing.hash = hash_of(numbers);
    things.push_back(thing);
  }
}

Eigen::AlignedBox3f box_around(const Vec3f& centre_m, float radius_m) {
  return {Vec3f(centre_m.array() - radius_m), Vec3f(centre_m.array() + radius_m)};
}

/// The things of one list that the other has not, and the other way round.
std::vector<DrawnThing> differing(const std::vector<DrawnThing>& before,
                                  const std::vector<DrawnThing>& now) {
  std::vector<DrawnThing> things;
  std::set_symmetric_difference(
      before.begin(), before.end(), now.begin(), now.end(), std::back_inserter(things),
      [](const DrawnThing& a, const DrawnThing& b) { return a.hash < b.hash; });
  return things;
}

/// Where a point lands: in [0, 1] across and up. None behind the camera.
std::optional<Eigen::Vector2f> on_screen(const FrameBlock& frame, const Vec3f& p_world_m) {
  const Eigen::Vector4f clip = frame.clip_from_world * p_world_m.homogeneous();
  if (clip.w() <= frame.lens.z()) return std::nullopt;  // nearer than the near plane
  return Eigen::Vector2f(0.5F * clip.head<2>() / clip.w() + Eigen::Vector2f::Constant(0.5F));
}

Eigen::AlignedBox2i in_pixels(const Box2f& share, int width_px, int height_px, int more_px) {
  if (share.isEmpty()) return {};
  const auto last = Eigen::Array2f(static_cast<float>(width_px), static_cast<float>(height_px));
  const auto pixel = [&](const Eigen::Vector2f& at) {  // far outside is outside
    return Eigen::Vector2i((at.array() * last).floor().max(-1e6F).min(1e6F).cast<int>());
  };
  return widened({pixel(share.min()), pixel(share.max())}, more_px, width_px, height_px);
}

}  // namespace

std::vector<DrawnThing> drawn_things(const DrawLists& lists) {
  std::vector<DrawnThing> things;
  add_triangles(lists, lists.casting, 0.0F, true, things);
  add_triangles(lists, lists.plain, 1.0F, false, things);
  add_triangles(lists, lists.ghost, 2.0F, false, things);
  add_triangles(lists, lists.translucent, 3.0F, false, things);
  for (const DrawBall& ball : lists.balls) {
    const Vec3f& p = ball.centre_m;
    things.push_back(
        {hash_of(std::array{p.x(), p.y(), p.z(), ball.radius_m, ball.rgb[0], ball.rgb[1],
                            ball.rgb[2], ball.casts_shadow ? 1.0F : 0.0F}),
         box_around(p, ball.radius_m), ball.casts_shadow});
  }
  for (std::size_t i = 0; i < lists.dots.size(); ++i) {
    const DrawDot& dot = lists.dots[i];
    const Vec3f& p = dot.p_world_m;
    const Vec3f& n = dot.n_world;
    const bool casts_shadow = i < lists.casting_dots;
    things.push_back(
        {hash_of(std::array{p.x(), p.y(), p.z(), dot.radius_m, n.x(), n.y(), n.z(), dot.rgb[0],
                            dot.rgb[1], dot.rgb[2], casts_shadow ? 1.0F : 0.0F}),
         box_around(p, dot.radius_m), casts_shadow});
  }
  std::sort(things.begin(), things.end(),
            [](const DrawnThing& a, const DrawnThing& b) { return a.hash < b.hash; });
  return things;
}

std::optional<ChangedArea> changed_area(const std::vector<DrawnThing>& before,
                                        const std::vector<DrawnThing>& now, const FrameBlock& frame,
                                        float lowest_m, int width_px, int height_px) {
  Box2f picture;
  Box2f shadow;
  const Vec3f to_light = frame.to_light.head<3>();
  const auto see = [&](const Vec3f& p_world_m) {
    const auto at = on_screen(frame, p_world_m);
    if (at) picture.extend(*at);
    return at.has_value();
  };
  for (const DrawnThing& thing : differing(before, now)) {
    for (int i = 0; i < 8; ++i) {
      const Vec3f p = thing.box_m.corner(static_cast<Eigen::AlignedBox3f::CornerType>(i));
      if (!see(p)) return std::nullopt;
      if (!thing.casts_shadow) continue;
      shadow.extend((frame.shadow_from_world * p.homogeneous()).head<2>());
      // down along the light, and past it: shadows begin some texels beside their edge
      const float fall_m = std::max(0.0F, p.z() - lowest_m) / std::max(to_light.z(), 1e-3F);
      if (!see(p - (fall_m + 8.0F * frame.to_light.w()) * to_light)) return std::nullopt;
    }
  }
  constexpr int kSoft_px = 8;  // penumbra and the squares of points
  return ChangedArea{in_pixels(picture, width_px, height_px, kSoft_px),
                     in_pixels(shadow, kShadowSide_px, kShadowSide_px, 2)};
}

Eigen::AlignedBox2i widened(const Eigen::AlignedBox2i& box_px, int by_px, int width_px,
                            int height_px) {
  if (box_px.isEmpty()) return {};
  const Eigen::AlignedBox2i whole(Eigen::Vector2i(0, 0),
                                  Eigen::Vector2i(width_px - 1, height_px - 1));
  return Eigen::AlignedBox2i(box_px.min().array() - by_px, box_px.max().array() + by_px)
      .intersection(whole);
}

}  // namespace gnbv
