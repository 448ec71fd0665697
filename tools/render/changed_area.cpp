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

// Bit for bit, as a picture would show it.
bool is_same(const DrawVertex& a, const DrawVertex& b) {
  static_assert(sizeof(DrawVertex) == 10 * sizeof(float));
  return std::memcmp(&a, &b, sizeof(a)) == 0;
}

bool is_same(const DrawDot& a, const DrawDot& b) {
  static_assert(sizeof(DrawDot) == 10 * sizeof(float));
  return std::memcmp(&a, &b, sizeof(a)) == 0;
}

bool is_same(const DrawBall& a, const DrawBall& b) {
  return a.centre_m == b.centre_m && a.radius_m == b.radius_m && a.rgb == b.rgb &&
         a.casts_shadow == b.casts_shadow;
}

using Indices = std::vector<std::uint32_t>;

DrawnThing triangle_of(const DrawLists& lists, const Indices& indices, std::size_t i, float kind,
                       bool casts_shadow) {
  DrawnThing thing{.box_m = {}, .casts_shadow = casts_shadow};
  std::array<float, 31> numbers{kind};
  for (std::size_t k = 0; k < 3; ++k) {
    const DrawVertex& vertex = lists.vertices[indices[3 * i + k]];
    thing.box_m.extend(vertex.p_world_m);
    auto* const to = numbers.data() + 1 + 10 * k;
    std::copy_n(vertex.p_world_m.data(), 3, to);
    std::copy_n(vertex.n_world.data(), 3, to + 3);
    std::copy_n(vertex.rgba.data(), 4, to + 6);
  }
  thing.hash = hash_of(numbers);
  return thing;
}

Eigen::AlignedBox3f box_around(const Vec3f& centre_m, float radius_m) {
  return {Vec3f(centre_m.array() - radius_m), Vec3f(centre_m.array() + radius_m)};
}

DrawnThing ball_of(const DrawBall& ball) {
  const Vec3f& p = ball.centre_m;
  return {hash_of(std::array{p.x(), p.y(), p.z(), ball.radius_m, ball.rgb[0], ball.rgb[1],
                             ball.rgb[2], ball.casts_shadow ? 1.0F : 0.0F}),
          box_around(p, ball.radius_m), ball.casts_shadow};
}

DrawnThing dot_of(const DrawLists& lists, std::size_t i) {
  const DrawDot& dot = lists.dots[i];
  const Vec3f& p = dot.p_world_m;
  const Vec3f& n = dot.n_world;
  const bool casts_shadow = i < lists.casting_dots;
  return {hash_of(std::array{p.x(), p.y(), p.z(), dot.radius_m, n.x(), n.y(), n.z(), dot.rgb[0],
                             dot.rgb[1], dot.rgb[2], casts_shadow ? 1.0F : 0.0F}),
          box_around(p, dot.radius_m), casts_shadow};
}

/// Things of two pictures; those with which both lists begin or end are passed over: of a hundred
/// thousand, all but some hundred.
struct Differing {
  std::vector<DrawnThing> before, now;

  template <class Same, class Thing>
  void add(const DrawLists& a, std::size_t count_a, const DrawLists& b, std::size_t count_b,
           const Same& same, const Thing& thing) {
    std::size_t begin = 0;
    while (begin < std::min(count_a, count_b) && same(begin, begin)) ++begin;
    while (std::min(count_a, count_b) > begin && same(count_a - 1, count_b - 1)) {
      --count_a;
      --count_b;
    }
    for (std::size_t i = begin; i < count_a; ++i) before.push_back(thing(a, i));
    for (std::size_t i = begin; i < count_b; ++i) now.push_back(thing(b, i));
  }

  void add_triangles(const DrawLists& a, const DrawLists& b, Indices DrawLists::*list, float kind,
                     bool casts_shadow) {
    const auto same = [&](std::size_t i, std::size_t j) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (!is_same(a.vertices[(a.*list)[3 * i + k]], b.vertices[(b.*list)[3 * j + k]])) {
          return false;
        }
      }
      return true;
    };
    add(a, (a.*list).size() / 3, b, (b.*list).size() / 3, same,
        [&](const DrawLists& of, std::size_t i) {
          return triangle_of(of, of.*list, i, kind, casts_shadow);
        });
  }

  /// Those without a partner in the other picture.
  std::vector<DrawnThing> alone() {
    const auto by_hash = [](const DrawnThing& a, const DrawnThing& b) { return a.hash < b.hash; };
    std::sort(before.begin(), before.end(), by_hash);
    std::sort(now.begin(), now.end(), by_hash);
    std::vector<DrawnThing> things;
    std::set_symmetric_difference(before.begin(), before.end(), now.begin(), now.end(),
                                  std::back_inserter(things), by_hash);
    return things;
  }
};

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

constexpr float kRounding_px = 2.0F;  // of where things land

/// Of pixels that a dot is drawn to.
struct Square {
  Eigen::Array2f middle_px;
  float half_px;
};

/// Those whose square comes near the box, or of whom nobody knows where they land.
template <class SquareOf>
std::vector<DrawDot> those_near(std::span<const DrawDot> dots, const Eigen::AlignedBox2i& box_px,
                                const SquareOf& square_of) {
  std::vector<DrawDot> near;
  if (box_px.isEmpty()) return near;
  const Eigen::Array2f low_px = box_px.min().cast<float>().array() - kRounding_px;
  const Eigen::Array2f high_px = box_px.max().cast<float>().array() + 1.0F + kRounding_px;
  for (const DrawDot& dot : dots) {
    const std::optional<Square> square = square_of(dot);
    const bool is_far = square && ((square->middle_px + square->half_px < low_px).any() ||
                                   (square->middle_px - square->half_px > high_px).any());
    if (!is_far) near.push_back(dot);
  }
  return near;
}

}  // namespace

std::vector<DrawnThing> changed_things(const DrawLists& before, const DrawLists& now) {
  Differing differing;
  differing.add_triangles(before, now, &DrawLists::casting, 0.0F, true);
  differing.add_triangles(before, now, &DrawLists::plain, 1.0F, false);
  differing.add_triangles(before, now, &DrawLists::ghost, 2.0F, false);
  differing.add_triangles(before, now, &DrawLists::translucent, 3.0F, false);
  differing.add(
      before, before.balls.size(), now, now.balls.size(),
      [&](std::size_t i, std::size_t j) { return is_same(before.balls[i], now.balls[j]); },
      [](const DrawLists& of, std::size_t i) { return ball_of(of.balls[i]); });
  differing.add(
      before, before.dots.size(), now, now.dots.size(),
      [&](std::size_t i, std::size_t j) {
        return is_same(before.dots[i], now.dots[j]) &&
               (i < before.casting_dots) == (j < now.casting_dots);
      },
      dot_of);
  return differing.alone();
}

std::optional<ChangedArea> changed_area(const std::vector<DrawnThing>& changed,
                                        const FrameBlock& frame, float lowest_m, int width_px,
                                        int height_px) {
  Box2f picture;
  Box2f shadow;
  const Vec3f to_light = frame.to_light.head<3>();
  const auto see = [&](const Vec3f& p_world_m) {
    const auto at = on_screen(frame, p_world_m);
    if (at) picture.extend(*at);
    return at.has_value();
  };
  for (const DrawnThing& thing : changed) {
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

std::vector<DrawDot> dots_in_picture(std::span<const DrawDot> dots, const FrameBlock& frame,
                                     const Eigen::AlignedBox2i& box_px, int width_px,
                                     int height_px) {
  const Eigen::Array2f size_px(static_cast<float>(width_px), static_cast<float>(height_px));
  return those_near(dots, box_px, [&](const DrawDot& dot) -> std::optional<Square> {
    const Eigen::Vector4f clip = frame.clip_from_world * dot.p_world_m.homogeneous();
    if (clip.w() <= frame.lens.z()) return std::nullopt;
    // gl_PointSize of kDotVertex, of pixels half as large
    const float side_px =
        0.5F * std::max(1.5F, dot.radius_m * frame.to_fill.w() * frame.eye.w() / clip.w());
    return Square{size_px * (0.5F * clip.head<2>().array() / clip.w() + 0.5F), 0.5F * side_px};
  });
}

std::vector<std::optional<Eigen::Vector2f>> places_px(const std::vector<DrawVertex>& vertices,
                                                      const FrameBlock& frame, int width_px,
                                                      int height_px) {
  const Eigen::Vector2f size_px(static_cast<float>(width_px), static_cast<float>(height_px));
  std::vector<std::optional<Eigen::Vector2f>> places(vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const auto at = on_screen(frame, vertices[i].p_world_m);
    if (at) places[i] = at->cwiseProduct(size_px);
  }
  return places;
}

std::vector<std::uint32_t> triangles_in_picture(
    const std::vector<std::optional<Eigen::Vector2f>>& places_px,
    const std::vector<std::uint32_t>& indices, const Eigen::AlignedBox2i& box_px) {
  if (box_px.isEmpty()) return {};
  const Box2f near_px(box_px.min().cast<float>().array() - kRounding_px,
                      box_px.max().cast<float>().array() + 1.0F + kRounding_px);
  Indices near;
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    Box2f triangle;
    bool is_known = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& corner = places_px[indices[i + k]];
      is_known = is_known && corner;
      if (corner) triangle.extend(*corner);
    }
    if (is_known && !triangle.intersects(near_px)) continue;
    for (std::size_t k = 0; k < 3; ++k) near.push_back(indices[i + k]);
  }
  return near;
}

std::vector<DrawDot> dots_in_shadow_map(std::span<const DrawDot> dots, const FrameBlock& frame,
                                        const Eigen::AlignedBox2i& box_px) {
  return those_near(dots, box_px, [&](const DrawDot& dot) -> std::optional<Square> {
    const Eigen::Vector4f at = frame.shadow_from_world * dot.p_world_m.homogeneous();
    // gl_PointSize of kBallShadowVertex
    const float side_px = 2.0F * dot.radius_m / frame.camera_right.w() * frame.camera_up.w();
    return Square{at.head<2>().array() * static_cast<float>(kShadowSide_px),
                  0.5F * std::max(1.0F, side_px)};
  });
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
