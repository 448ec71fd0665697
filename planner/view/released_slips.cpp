#include "planner/view/released_slips.hpp"

#include <cmath>
#include <optional>

#include "planner/map/ray_walk.hpp"
#include "planner/view/each_ray.hpp"

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
    found.prediction_hit = found.prediction_hit || grid.is_predicted(v);
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

/// Turns the voxels before the hit into those that count.
void apply_slips(const OccupancyGrid& grid, const RayOrigin& origin, const ReleasedSlips& slips,
                 Cast& found) {
  if (!found.hit) return;
  if (slips.excludes_hit_voxel) {
    const GridGeometry& geometry = grid.geometry();
    const Vec3f center_m = geometry.center_m(geometry.key_at(*found.hit)).cast<float>();
    found.voxels.clear();
    walk_ray_inside(geometry, origin, center_m, [&](VoxelIndex v) {
      found.voxels.push_back(v);
      return true;
    });
  } else if (!slips.prediction_hides_hits || found.prediction_hit) {
    found.voxels.push_back(*found.hit);
  }
}

/// Adds the voxel if it is new to the view.
void see(const OccupancyGrid& grid, const SurfaceCloud& cloud, VoxelIndex v, double sparse_below,
         std::vector<bool>& seen, ViewStats& stats) {
  stats.entropy_per_ray_nat += static_cast<double>(grid.entropy_nat(v));
  if (seen[v]) return;
  seen[v] = true;
  stats.entropy_nat += static_cast<double>(grid.entropy_nat(v));
  switch (grid.state(v)) {
    case VoxelState::free:
      ++stats.free_voxels;
      return;
    case VoxelState::unknown:
      ++stats.unknown_voxels;
      return;
    case VoxelState::occupied:
      ++stats.occupied_voxels;
      const double density = cloud.density(v);
      stats.density_sum += density;
      stats.sparse_voxels += static_cast<std::uint32_t>(density > 0.0 && density < sparse_below);
      return;
  }
}

}  // namespace

ViewStats evaluate_view_with_slips(const OccupancyGrid& grid, const SurfaceCloud& cloud,
                                   const ViewRays& rays, const ViewPose& candidate,
                                   const ReleasedSlips& slips, double sparse_below) {
  const GridGeometry& geometry = grid.geometry();
  ViewStats stats;
  stats.voxel_m3 = std::pow(geometry.resolution_m(), 3);
  std::vector<bool> seen(geometry.voxel_count(), false);
  std::vector<bool> predicted(geometry.voxel_count(), false);
  for_each_ray(geometry, rays, candidate, [&](const RayOrigin& origin, const Vec3f& end_m) {
    Cast found = cast(grid, origin, end_m);
    apply_slips(grid, origin, slips, found);
    for (const VoxelIndex v : found.voxels) {
      see(grid, cloud, v, sparse_below, seen, stats);
    }
    if (found.first_predicted && !predicted[*found.first_predicted]) {
      predicted[*found.first_predicted] = true;
      ++stats.predicted_voxels;
    }
  });
  return stats;
}

}  // namespace gnbv
