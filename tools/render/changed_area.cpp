#include <algorithm>
#include <cstring>

#include "tools/render/geometry.hpp"

namespace gnbv {
namespace {

using Box2f = Eigen::AlignedBox2f;

/// Bit for bit, as a picture would show it.
template <typename Thing>
bool is_same(const Thing& a, const Thing& b) {
  static_assert(sizeof(Thing) % sizeof(float) == 0);
  return std::memcmp(&a, &b, sizeof a) == 0;
}

/// Where a point lands: in [0, 1] across and up. None behind the camera.
std::optional<Eigen::Vector2f> on_screen(const FrameBlock& frame, const Vec3f& p_world_m) {
  const Eigen::Vector4f clip = frame.clip_from_world * p_world_m.homogeneous();
  if (clip.w() <= frame.lens.z()) return std::nullopt;  // nearer than the near plane
  return Eigen::Vector2f(0.5F * clip.head<2>() / clip.w() + Eigen::Vector2f::Constant(0.5F));
}

/// Parts of the picture and of the shadow map that hold what was added.
struct Reach {
  const FrameBlock& frame;
  float lowest_m;
  Box2f picture = {}, shadow = {};
  bool is_behind = false;

  void see(const Vec3f& p_world_m) {
    const auto at = on_screen(frame, p_world_m);
    is_behind = is_behind || !at;
    if (at) picture.extend(*at);
  }

  void add(const Vec3f& p_world_m, bool casts_shadow) {
    see(p_world_m);
    if (!casts_shadow) return;
    shadow.extend((frame.shadow_from_world * p_world_m.homogeneous()).head<2>());
    // down along the light, and past it: shadows begin some texels beside their edge
    const Vec3f to_light = frame.to_light.head<3>();
    const float fall_m = std::max(0.0F, p_world_m.z() - lowest_m) / std::max(to_light.z(), 1e-3F);
    see(p_world_m - (fall_m + 8.0F * frame.to_light.w()) * to_light);
  }

  /// Balls and dots.
  template <typename Round>
  void add_changed(std::span<const Round> a, std::span<const Round> b, bool casts_shadow) {
    const auto add_round = [&](const Round& thing) {
      const Vec3f& p = thing.p_world_m;
      const Eigen::AlignedBox3f box_m(p.array() - thing.radius_m, p.array() + thing.radius_m);
      for (int i = 0; i < 8; ++i) {
        add(box_m.corner(static_cast<Eigen::AlignedBox3f::CornerType>(i)), casts_shadow);
      }
    };
    for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
      if (i < a.size() && i < b.size() && is_same(a[i], b[i])) continue;
      if (i < a.size()) add_round(a[i]);
      if (i < b.size()) add_round(b[i]);
    }
  }

  void add_changed(const DrawLists& a, const DrawLists& b,
                   std::vector<std::uint32_t> DrawLists::*triangles, bool casts_shadow) {
    const auto corner = [&](const DrawLists& lists, std::size_t i) -> const DrawVertex& {
      return lists.vertices[(lists.*triangles)[i]];
    };
    const std::size_t count_a = (a.*triangles).size();
    const std::size_t count_b = (b.*triangles).size();
    for (std::size_t i = 0; i < std::max(count_a, count_b); i += 3) {
      bool is_kept = i < count_a && i < count_b;
      for (std::size_t k = i; is_kept && k < i + 3; ++k) {
        is_kept = is_same(corner(a, k), corner(b, k));
      }
      for (std::size_t k = i; !is_kept && k < i + 3; ++k) {
        if (i < count_a) add(corner(a, k).p_world_m, casts_shadow);
        if (i < count_b) add(corner(b, k).p_world_m, casts_shadow);
      }
    }
  }
};

PixelBox in_pixels(const Box2f& share, int width_px, int height_px, int more_px) {
  if (share.isEmpty()) return {};
  const auto size_px = Eigen::Array2f(static_cast<float>(width_px), static_cast<float>(height_px));
  const auto pixel = [&](const Eigen::Vector2f& at) {  // far outside is outside
    return Eigen::Vector2i((at.array() * size_px).floor().max(-1e6F).min(1e6F).cast<int>());
  };
  return widened({pixel(share.min()), pixel(share.max())}, more_px, width_px, height_px);
}

/// Those that may reach into the box of a picture of that size: seen by `share_from_world`, which
/// leads to [0, 1], as points whose half side is `half_side` radii by their depth, or half a pixel.
std::vector<DrawDot> those_near(std::span<const DrawDot> dots,
                                const Eigen::Matrix4f& share_from_world, float half_side,
                                const PixelBox& box_px, int width_px, int height_px) {
  constexpr float kRounding_px = 2.0F;
  std::vector<DrawDot> near;
  if (box_px.isEmpty()) return near;
  const Eigen::Array2f size_px(static_cast<float>(width_px), static_cast<float>(height_px));
  const Eigen::Array2f low_px = box_px.min().cast<float>().array();
  const Eigen::Array2f high_px = box_px.max().cast<float>().array() + 1.0F;
  std::copy_if(dots.begin(), dots.end(), std::back_inserter(near), [&](const DrawDot& dot) {
    const Eigen::Vector4f at = share_from_world * dot.p_world_m.homogeneous();
    if (at.w() <= 1e-6F) return true;  // nobody knows where it lands
    const Eigen::Array2f middle_px = at.head<2>().array() / at.w() * size_px;
    const float reach_px =
        std::max(0.5F, half_side * dot.radius_m * size_px.y() / at.w()) + kRounding_px;
    return (middle_px + reach_px >= low_px).all() && (middle_px - reach_px <= high_px).all();
  });
  return near;
}

}  // namespace

std::optional<ChangedArea> changed_area(const DrawLists& before, const DrawLists& now,
                                        const FrameBlock& frame, float lowest_m, int width_px,
                                        int height_px) {
  Reach reach{frame, lowest_m};
  reach.add_changed(before, now, &DrawLists::casting, true);
  for (const auto list : {&DrawLists::plain, &DrawLists::ghost, &DrawLists::translucent}) {
    reach.add_changed(before, now, list, false);
  }
  const std::span a(before.balls), b(now.balls);
  reach.add_changed(a.first(before.casting_balls), b.first(now.casting_balls), true);
  reach.add_changed(a.subspan(before.casting_balls), b.subspan(now.casting_balls), false);
  reach.add_changed(std::span(before.dots), std::span(now.dots), true);
  if (reach.is_behind) return std::nullopt;
  constexpr int kSoft_px = 8;  // penumbra and the squares of points
  return ChangedArea{in_pixels(reach.picture, width_px, height_px, kSoft_px),
                     in_pixels(reach.shadow, kShadowSide_px, kShadowSide_px, 2)};
}

std::vector<DrawDot> dots_in_picture(std::span<const DrawDot> dots, const FrameBlock& frame,
                                     const PixelBox& box_px, int width_px, int height_px) {
  Eigen::Matrix4f share_from_world = 0.5F * frame.clip_from_world;
  share_from_world.row(3) *= 2.0F;
  share_from_world.topRows<2>().rowwise() += 0.5F * frame.clip_from_world.row(3);
  // gl_PointSize of kDotVertex, of pixels half as large
  return those_near(dots, share_from_world, 0.5F * frame.to_fill.w(), box_px, width_px, height_px);
}

std::vector<DrawDot> dots_in_shadow_map(std::span<const DrawDot> dots, const FrameBlock& frame,
                                        const PixelBox& box_px) {
  // gl_PointSize of kBallShadowVertex
  return those_near(dots, frame.shadow_from_world, 1.0F / frame.camera_right.w(), box_px,
                    kShadowSide_px, kShadowSide_px);
}

PixelBox widened(const PixelBox& box_px, int by_px, int width_px, int height_px) {
  if (box_px.isEmpty()) return {};
  return PixelBox(box_px.min().array() - by_px, box_px.max().array() + by_px)
      .intersection(whole_px(width_px, height_px));
}

}  // namespace gnbv
