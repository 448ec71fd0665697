// A view looked at ray by ray: what evaluate_view() does not count.
#include <algorithm>
#include <cmath>
#include <optional>

#include "planner/map/ray_walk.hpp"
#include "planner/view/visibility.hpp"

namespace gnbv {
namespace {

/// What casting a ray finds before it leaves its range or the grid.
struct Cast {
  std::vector<VoxelIndex> voxels;             // up to, not including, a hit
  std::optional<VoxelIndex> hit;              // first occupied voxel
  std::optional<VoxelIndex> first_predicted;  // no farther than the hit
  bool prediction_hit = false;                // any predicted voxel, before or behind the hit
};

Cast cast(const OccupancyGrid& grid, const RayOrigin& origin, const Vec3f& end_m) {
  Cast found;
  walk_ray_inside(grid.geometry(), origin, end_m, [&](VoxelIndex v) {
    found.prediction_hit |= grid.is_predicted(v);
    if (found.hit) return !found.prediction_hit;
    if (grid.is_predicted(v) && !found.first_predicted) found.first_predicted = v;
    if (grid.state(v) == VoxelState::occupied) {
      found.hit = v;
    } else {
      found.voxels.push_back(v);
    }
    return true;
  });
  return found;
}

/// Calls use(found, origin) for each ray of a view from that pose, camera after camera. An origin
/// outside the map is taken to its nearest place inside.
template <typename Use>
void cast_each(const OccupancyGrid& grid, const ViewRays& rays, const ViewPose& view,
               const Use& use) {
  const GridGeometry& geometry = grid.geometry();
  const Isometry T = T_world_body(view);
  const auto& [x_m, y_m, z_m] = rays.end_body_m;
  for (const ViewRays::Camera& camera : rays.cameras) {
    const Vec3f origin_m = geometry.nearest_inside(T * camera.origin_body_m).cast<float>();
    const RayOrigin origin = make_ray_origin(geometry, origin_m);
    for (std::size_t i = camera.first; i < camera.first + camera.count; ++i) {
      const Vec3 end_m = T * Vec3(x_m[i], y_m[i], z_m[i]);
      use(cast(grid, origin, end_m.cast<float>()), origin);
    }
  }
}

/// The voxels that count, with the slips.
std::vector<VoxelIndex> counted(const GridGeometry& geometry, const RayOrigin& origin,
                                const ReleasedSlips& slips, const Cast& found) {
  std::vector<VoxelIndex> voxels;
  if (!found.hit || !slips.excludes_hit_voxel) {
    voxels = found.voxels;
    const bool hides_hit = slips.prediction_hides_hits && !found.prediction_hit;
    if (found.hit && !hides_hit) voxels.push_back(*found.hit);
    return voxels;
  }
  const Vec3f center_m = geometry.center_m(geometry.key_at(*found.hit)).cast<float>();
  walk_ray_inside(geometry, origin, center_m, [&](VoxelIndex v) {
    voxels.push_back(v);
    return true;
  });
  return voxels;
}

void sort_unique(std::vector<VoxelIndex>& voxels) {
  std::sort(voxels.begin(), voxels.end());
  voxels.erase(std::unique(voxels.begin(), voxels.end()), voxels.end());
}

}  // namespace

ViewStats evaluate_view_with_slips(const OccupancyGrid& grid, const SurfaceCloud& cloud,
                                   const ViewRays& rays, const ViewPose& candidate,
                                   const ReleasedSlips& slips, double sparse_below) {
  const GridGeometry& geometry = grid.geometry();
  ViewStats stats;
  stats.voxel_m3 = std::pow(geometry.resolution_m(), 3);
  std::vector<bool> is_seen(geometry.voxel_count(), false);
  std::vector<VoxelIndex> predicted;
  cast_each(grid, rays, candidate, [&](const Cast& found, const RayOrigin& origin) {
    if (found.first_predicted) predicted.push_back(*found.first_predicted);
    for (const VoxelIndex v : counted(geometry, origin, slips, found)) {
      const double entropy_nat = grid.entropy_nat(v);
      stats.entropy_per_ray_nat += entropy_nat;
      if (is_seen[v]) continue;
      is_seen[v] = true;
      stats.entropy_nat += entropy_nat;
      stats.free_voxels += grid.state(v) == VoxelState::free;
      stats.unknown_voxels += grid.state(v) == VoxelState::unknown;
      if (grid.state(v) != VoxelState::occupied) continue;
      const double density = cloud.density(v);
      ++stats.occupied_voxels;
      stats.density_sum += density;
      stats.sparse_voxels += density > 0.0 && density < sparse_below;
    }
  });
  sort_unique(predicted);
  stats.predicted_voxels = static_cast<std::uint32_t>(predicted.size());
  return stats;
}

VoxelsInSight voxels_in_sight(const OccupancyGrid& grid, const ViewRays& rays,
                              const ViewPose& view) {
  VoxelsInSight seen;
  cast_each(grid, rays, view, [&](const Cast& found, const RayOrigin&) {
    if (found.first_predicted) seen.predicted.push_back(*found.first_predicted);
    for (const VoxelIndex v : found.voxels) {
      if (grid.state(v) == VoxelState::unknown) seen.unknown.push_back(v);
    }
  });
  sort_unique(seen.unknown);
  sort_unique(seen.predicted);
  return seen;
}

}  // namespace gnbv
