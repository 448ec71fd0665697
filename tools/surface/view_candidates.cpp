// view_candidates() of texture_views.hpp.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "sim/core/parallel.hpp"
#include "tools/surface/texture_views.hpp"

namespace gnbv {
namespace {

constexpr float kBlock_m = 1.0F;
constexpr float kGoodShare = 0.6F;
constexpr std::size_t kMostTried = 24;  // once one is kept, rays for no more views of the face
constexpr std::size_t kMostKept = 12;   // candidates of a face
constexpr float kBorder_px = 1.0F;      // of the picture, not used
constexpr float kOutline_px = 1.5F;     // rays pass this far outside of a face's corners
constexpr float kLeastCosine = 0.1F;    // flatter faces show no more than smears

/// Neighbouring faces, and a ball around them.
struct Block {
  std::vector<std::uint32_t> faces;
  Vec3f centre_m = Vec3f::Zero();
  float radius_m = 0.0F;
};

struct Corners {
  std::array<Vec3f, 3> p_m;
  Vec3f middle_m;
  Vec3f normal;  // unit, out of the structure; zero without area
};

Corners corners_of(const TriangleMesh& mesh, std::uint32_t face) {
  Corners c;
  for (std::size_t k = 0; k < 3; ++k) c.p_m[k] = mesh.vertices_m[mesh.faces[face][k]];
  c.middle_m = (c.p_m[0] + c.p_m[1] + c.p_m[2]) / 3.0F;
  c.normal = (c.p_m[1] - c.p_m[0]).cross(c.p_m[2] - c.p_m[0]).normalized();
  return c;
}

std::vector<Block> blocks_of(const TriangleMesh& mesh) {
  std::map<std::array<int, 3>, Block> by_cell;
  for (std::uint32_t face = 0; face < mesh.faces.size(); ++face) {
    const Vec3f middle_m = corners_of(mesh, face).middle_m;
    std::array<int, 3> cell{};
    for (std::size_t k = 0; k < 3; ++k) {
      cell[k] = static_cast<int>(std::floor(middle_m[static_cast<Eigen::Index>(k)] / kBlock_m));
    }
    by_cell[cell].faces.push_back(face);
  }
  std::vector<Block> blocks;
  for (auto& [cell, block] : by_cell) {
    Eigen::AlignedBox3f box;
    for (const std::uint32_t face : block.faces) {
      for (const std::uint32_t vertex : mesh.faces[face]) box.extend(mesh.vertices_m[vertex]);
    }
    block.centre_m = box.center();
    block.radius_m = 0.5F * box.diagonal().norm();
    blocks.push_back(std::move(block));
  }
  return blocks;
}

/// Whether any of the ball may be in the picture.
bool may_show(const TextureView& view, const Block& block) {
  const Vec3 c_m = view.T_camera_world * block.centre_m.cast<double>();
  const double r_m = block.radius_m;
  if (c_m.z() < -r_m) return false;
  // signed distances to the four planes through the camera and the picture's borders
  const auto outside_m = [&](double slope, double across_m) {
    return (across_m - slope * c_m.z()) / std::hypot(1.0, slope);
  };
  const FrameCamera& k = view.camera;
  if (k.lens) {
    const Eigen::AlignedBox2d& sight = k.lens->sight();
    return outside_m(sight.max().x(), c_m.x()) <= r_m &&
           outside_m(-sight.min().x(), -c_m.x()) <= r_m &&
           outside_m(sight.max().y(), c_m.y()) <= r_m &&
           outside_m(-sight.min().y(), -c_m.y()) <= r_m;
  }
  return outside_m((k.width_px - k.cx_px) / k.fx_px, c_m.x()) <= r_m &&
         outside_m(k.cx_px / k.fx_px, -c_m.x()) <= r_m &&
         outside_m((k.height_px - k.cy_px) / k.fy_px, c_m.y()) <= r_m &&
         outside_m(k.cy_px / k.fy_px, -c_m.y()) <= r_m;
}

bool is_in_picture(const TextureView& view, const Vec3f& p_world_m) {
  constexpr double kNear_m = 0.05;
  if ((view.T_camera_world * p_world_m.cast<double>()).z() < kNear_m) return false;
  const Vec2f px = view.pixel_of(p_world_m);
  return px.x() >= kBorder_px && px.y() >= kBorder_px &&
         px.x() <= static_cast<float>(view.camera.width_px) - kBorder_px &&
         px.y() <= static_cast<float>(view.camera.height_px) - kBorder_px;
}

/// 0 where the face is turned away or not in the picture.
float quality_of(const TextureView& view, const Corners& c, double texels_per_m) {
  const Vec3f to_camera_m = view.p_world_m - c.middle_m;
  const float distance_m = to_camera_m.norm();
  const float cosine = c.normal.dot(to_camera_m) / distance_m;
  if (!(cosine > kLeastCosine)) return 0.0F;
  for (const Vec3f& corner_m : c.p_m) {
    if (!is_in_picture(view, corner_m)) return 0.0F;
  }
  const auto texels = static_cast<float>(std::sqrt(view.camera.fx_px * view.camera.fy_px) /
                                         (distance_m * texels_per_m));
  return cosine * std::min(1.0F, cosine * texels * texels);
}

/// Whether rays to the middle and past each corner meet nothing before the face; and, unless
/// `beyond_is_known`, nothing far behind it.
bool is_clear(const RayScene& scene, const TextureView& view, const Corners& c, float hidden_m,
              bool beyond_is_known) {
  std::array<Vec3f, 4> targets_m = {c.middle_m, c.p_m[0], c.p_m[1], c.p_m[2]};
  const float past_m = kOutline_px * (c.middle_m - view.p_world_m).norm() /
                       static_cast<float>(std::min(view.camera.fx_px, view.camera.fy_px));
  for (std::size_t k = 1; k < 4; ++k) {
    targets_m[k] += past_m * (targets_m[k] - c.middle_m).normalized();
  }
  std::array<Vec3f, 4> directions;
  for (std::size_t k = 0; k < 4; ++k) directions[k] = targets_m[k] - view.p_world_m;
  std::array<RayHit, 4> hits;
  scene.first_hits(view.p_world_m, std::span<const Vec3f>(directions), 0.0F, 2.0F, hits);
  for (std::size_t k = 0; k < 4; ++k) {
    // distances are in multiples of the direction; a curved surface may lie a little behind
    const float off_m = (hits[k].distance_m - 1.0F) * directions[k].norm();
    if (off_m < -hidden_m || (off_m > 3.0F * hidden_m && !beyond_is_known)) return false;
  }
  return true;
}

enum class DepthSays { agrees, nothing, otherwise };

/// What the depth measured around the corners says of them.
DepthSays depth_at(const TextureView& view, const Corners& c, float hidden_m) {
  const GreyImage16& depth = view.depth_steps;
  if (depth.values.empty()) return DepthSays::nothing;
  DepthSays says = DepthSays::agrees;
  for (const Vec3f& corner_m : c.p_m) {
    const double z_m = (view.T_camera_world * corner_m.cast<double>()).z();
    const Vec2f px = view.pixel_of(corner_m);
    for (int i = 0; i < 4; ++i) {  // the four pixels around it
      const int u = std::clamp(static_cast<int>(px.x() - 0.5F) + i % 2, 0, depth.width_px - 1);
      const int v = std::clamp(static_cast<int>(px.y() - 0.5F) + i / 2, 0, depth.height_px - 1);
      const auto at = static_cast<std::size_t>(v) * static_cast<std::size_t>(depth.width_px) +
                      static_cast<std::size_t>(u);
      const double off_m = depth.values[at] * view.camera.depth_scale_m - z_m;
      if (depth.values[at] == 0 && z_m > view.range_max_m) {
        says = DepthSays::nothing;
      } else if (std::abs(off_m) > 2.0 * static_cast<double>(hidden_m)) {  // none reads as 0
        return DepthSays::otherwise;
      }
    }
  }
  return says;
}

std::vector<ViewCandidate> candidates_of(const Corners& c, const RayScene& scene,
                                         std::span<const TextureView> views,
                                         std::span<const std::uint32_t> near,
                                         const ViewChoiceSettings& settings) {
  std::vector<ViewCandidate> all;
  for (const std::uint32_t view : near) {
    const float quality = quality_of(views[view], c, settings.texels_per_m);
    if (quality > 0.0F) all.push_back({view, quality});
  }
  std::sort(all.begin(), all.end(), [](const ViewCandidate& a, const ViewCandidate& b) {
    return a.quality != b.quality ? a.quality > b.quality : a.view < b.view;
  });
  std::vector<ViewCandidate> kept;
  std::optional<ViewCandidate> unmeasured;  // the best beyond its camera's range
  std::size_t tried = 0;
  const auto hidden_m = static_cast<float>(settings.hidden_m);
  for (const ViewCandidate& candidate : all) {
    const bool is_enough = !kept.empty() && (candidate.quality < kGoodShare * kept[0].quality ||
                                             kept.size() == kMostKept || tried >= kMostTried);
    if (is_enough) break;
    const TextureView& view = views[candidate.view];
    const DepthSays depth = depth_at(view, c, hidden_m);
    const bool is_last_choice = depth == DepthSays::nothing && !view.depth_steps.values.empty();
    if (depth == DepthSays::otherwise || (is_last_choice && unmeasured)) continue;
    ++tried;
    if (!is_clear(scene, view, c, hidden_m, depth == DepthSays::agrees)) continue;
    if (is_last_choice) {
      unmeasured = candidate;
    } else {
      kept.push_back(candidate);
    }
  }
  if (kept.empty() && unmeasured) kept.push_back(*unmeasured);
  return kept;
}

}  // namespace

std::vector<std::vector<ViewCandidate>> view_candidates(const TriangleMesh& mesh,
                                                        const RayScene& scene,
                                                        std::span<const TextureView> views,
                                                        const ViewChoiceSettings& settings,
                                                        int threads) {
  const std::vector<Block> blocks = blocks_of(mesh);
  std::vector<std::vector<ViewCandidate>> candidates(mesh.faces.size());
  parallel_for(threads, blocks.size(), [&](std::size_t b) {
    std::vector<std::uint32_t> near;
    for (std::uint32_t view = 0; view < views.size(); ++view) {
      if (may_show(views[view], blocks[b])) near.push_back(view);
    }
    for (const std::uint32_t face : blocks[b].faces) {
      candidates[face] = candidates_of(corners_of(mesh, face), scene, views, near, settings);
    }
  });
  return candidates;
}

}  // namespace gnbv
