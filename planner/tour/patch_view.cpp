#include "planner/tour/patch_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/map/ray_walk.hpp"
#include "planner/tour/success.hpp"

namespace gnbv {
namespace {

constexpr double kPixel_rad = deg_to_rad(0.6);
// of a disc, in the edge of a small voxel: 0.9 of the discs' spacing leaves no holes (this and the
// bias: facts/tour.md, section 1, splats of 0.09 m with a bias of 0.08 m for a spacing of 0.1 m)
constexpr float kDiscRadius = 1.8F;
// what lies no deeper behind a disc is the disc's own surface
constexpr float kBias = 1.6F;
constexpr float kNoDepth = std::numeric_limits<float>::infinity();

}  // namespace

bool is_hit_first(const OccupancyGrid& grid, const Vec3& origin_world_m,
                  const Vec3& target_world_m) {
  const GridGeometry& geometry = grid.geometry();
  const Key target = geometry.key_of(target_world_m);
  bool is_clear = true;
  walk_ray(geometry, origin_world_m.cast<float>(), target_world_m.cast<float>(),
           [&](const Key& key) {
             if (!geometry.contains(key)) return true;
             if (grid.state(geometry.index_of(key)) != VoxelState::occupied) return true;
             for (std::size_t a = 0; a < 3; ++a)
               is_clear = is_clear && std::abs(key[a] - target[a]) <= 1;
             return false;
           });
  return is_clear;
}

double camera_reach_m(const CameraModel& camera) {
  const CameraConfig& c = camera.config;
  const double across = std::hypot(std::tan(0.5 * c.fov_x_rad), std::tan(0.5 * c.fov_y_rad));
  return c.range_max_m * std::sqrt(1.0 + across * across) + c.p_body_m.norm();
}

CellBlocks::CellBlocks(const Box3& workspace_m, double cell_m)
    : lattice_(workspace_m, 8.0 * cell_m), slot_(lattice_.voxel_count()) {}

void CellBlocks::follow(const SurfaceCells& cells) {
  for (; taken_ < cells.cells().size(); ++taken_) {
    const SurfaceCell& cell = cells.cells()[taken_];
    const Key key = lattice_.key_of(cells.lattice().center_m(cell.key));
    if (!lattice_.contains(key)) continue;  // half a cell beyond the workspace
    const VoxelIndex block = lattice_.index_of(key);
    if (slot_[block] == 0) {
      blocks_.push_back({lattice_.center_m(key).cast<float>(), {}});
      slot_[block] = static_cast<std::uint32_t>(blocks_.size());
    }
    blocks_[slot_[block] - 1].cells.push_back(static_cast<std::uint32_t>(taken_));
  }
}

std::vector<const CellBlocks::Block*> CellBlocks::near(const Vec3& p_world_m,
                                                       double reach_m) const {
  const float within_m = static_cast<float>(reach_m) + radius_m();
  std::vector<const Block*> found;
  for (const Block& block : blocks_) {
    const float distance2_m2 = (block.center_m - p_world_m.cast<float>()).squaredNorm();
    if (distance2_m2 <= within_m * within_m) found.push_back(&block);
  }
  return found;
}

void PatchViewer::begin(const CameraModel& camera, const Isometry& T_world_camera) {
  const CameraConfig& c = camera.config;
  const double half_x = std::tan(0.5 * c.fov_x_rad);
  const double half_y = std::tan(0.5 * c.fov_y_rad);
  image_.width = static_cast<int>(std::ceil(2.0 * half_x / kPixel_rad));
  image_.height = static_cast<int>(std::ceil(2.0 * half_y / kPixel_rad));
  image_.cx = 0.5F * static_cast<float>(image_.width);
  image_.cy = 0.5F * static_cast<float>(image_.height);
  image_.fx = image_.cx / static_cast<float>(half_x);
  image_.fy = image_.cy / static_cast<float>(half_y);
  image_.R_camera_world = T_world_camera.linear().transpose().cast<float>();
  image_.origin_m = T_world_camera.translation().cast<float>();
  image_.range_max_m = static_cast<float>(c.range_max_m);
  depth_m_.assign(static_cast<std::size_t>(image_.width * image_.height), kNoDepth);
}

/// The disc as seen through each pixel that its bounding square covers.
void PatchViewer::draw(const Vec3f& p, const Vec3f& normal, float radius_m) {
  const float along = normal.dot(p);
  const float u = image_.fx * p.x() / p.z() + image_.cx;
  const float v = image_.fy * p.y() / p.z() + image_.cy;
  const float half = image_.fx * radius_m / p.z();
  const int u0 = std::max(0, static_cast<int>(std::ceil(u - half - 0.5F)));
  const int u1 = std::min(image_.width - 1, static_cast<int>(std::floor(u + half - 0.5F)));
  const int v0 = std::max(0, static_cast<int>(std::ceil(v - half - 0.5F)));
  const int v1 = std::min(image_.height - 1, static_cast<int>(std::floor(v + half - 0.5F)));
  for (int y = v0; y <= v1; ++y) {
    for (int x = u0; x <= u1; ++x) {
      const Vec3f ray((static_cast<float>(x) + 0.5F - image_.cx) / image_.fx,
                      (static_cast<float>(y) + 0.5F - image_.cy) / image_.fy, 1.0F);
      const float across = normal.dot(ray);
      if (std::fabs(across) < 1e-3F) continue;
      const float z_m = along / across;
      if (!((z_m * ray - p).squaredNorm() <= radius_m * radius_m)) continue;
      float& depth_m = depth_m_[static_cast<std::size_t>(y * image_.width + x)];
      depth_m = std::min(depth_m, z_m);
    }
  }
}

bool PatchViewer::is_before(const Vec3f& p, float cos_incidence, float bias_m) const {
  const int x = static_cast<int>(image_.fx * p.x() / p.z() + image_.cx);
  const int y = static_cast<int>(image_.fy * p.y() / p.z() + image_.cy);
  if (x < 0 || y < 0 || x >= image_.width || y >= image_.height) return false;
  const float half_pixel = 0.5F / image_.fx;
  return p.z() <= depth_m_[static_cast<std::size_t>(y * image_.width + x)] + bias_m +
                      half_pixel * p.z() / cos_incidence;
}

bool PatchViewer::is_in_image(const Vec3f& p, float margin_m) const {
  return p.z() > 0.05F && p.z() <= image_.range_max_m + margin_m && is_in_cone(p, margin_m);
}

bool PatchViewer::is_in_cone(const Vec3f& p, float margin_m) const {
  return std::fabs(p.x()) <= image_.cx / image_.fx * p.z() + margin_m &&
         std::fabs(p.y()) <= image_.cy / image_.fy * p.z() + margin_m;
}

void PatchViewer::draw_cell(const TourScene& scene, std::uint32_t index) {
  const SurfaceCell& cell = scene.cells.cells()[index];
  if (cell.discs_m.empty() && !cell.is_frontier) return;
  const Vec3f& at_m = cell.is_frontier ? cell.on_plane_m : cell.discs_m.front();
  const auto cell_m = static_cast<float>(scene.cells.edge_m());
  if (!is_in_image(to_camera(at_m), slant() * 0.9F * cell_m)) return;
  in_image_.push_back(index);
  if (scene.config.visibility != TourVisibility::splats) return;
  const float radius_m = kDiscRadius * static_cast<float>(scene.cells.detail_m());
  const Vec3f normal = image_.R_camera_world * cell.normal;
  for (const Vec3f& disc_m : cell.discs_m) {
    const Vec3f p = to_camera(disc_m);
    if (!is_in_image(p, radius_m)) continue;
    draw(p, cell.has_plane ? normal : Vec3f(-p.normalized()), radius_m);
  }
}

bool PatchViewer::is_seen(const TourScene& scene, const Patch& patch, float cosine) const {
  const Vec3f p = to_camera(patch.target_m);
  if (scene.config.visibility == TourVisibility::splats) {
    return is_before(p, cosine, kBias * static_cast<float>(scene.cells.detail_m()));
  }
  return is_hit_first(scene.grid, image_.origin_m.cast<double>(), patch.target_m.cast<double>());
}

void PatchViewer::look(const TourScene& scene, const CameraModel& camera,
                       const Isometry& T_world_body,
                       std::span<const CellBlocks::Block* const> blocks, float block_radius_m,
                       std::vector<SeenPatch>& seen) {
  begin(camera, T_world_body * camera.T_body_camera);
  in_image_.clear();
  for (const CellBlocks::Block* block : blocks) {
    const Vec3f middle = to_camera(block->center_m);
    const bool is_in_reach =
        middle.z() >= -block_radius_m && middle.z() <= image_.range_max_m + block_radius_m;
    if (!is_in_reach || !is_in_cone(middle, slant() * block_radius_m)) continue;
    for (const std::uint32_t index : block->cells) draw_cell(scene, index);
  }
  const auto range_min_m = static_cast<float>(camera.config.range_min_m);
  const auto cos_min = static_cast<float>(std::cos(scene.config.incidence_max_rad));
  for (const std::uint32_t index : in_image_) {
    for (std::uint32_t side = 0; side < 2; ++side) {
      const PatchId id = 2 * index + side;
      const Patch& patch = scene.patches[id];
      if (patch.missing <= 0.0F) continue;
      const Vec3f p = to_camera(patch.target_m);
      if (!is_in_image(p, 0.0F) || p.z() < range_min_m) continue;
      const float cosine = patch.normal.dot(image_.origin_m - patch.target_m) / p.norm();
      if (cosine < cos_min || !is_seen(scene, patch, cosine)) continue;
      seen.push_back({id, static_cast<std::uint8_t>(incidence_bin(cosine))});
    }
  }
}

}  // namespace gnbv
