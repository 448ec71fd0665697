#include "planner/view/ray_by_ray.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "planner/map/ray_walk.hpp"

namespace gnbv {
namespace {

/// Calls use(origin, end_world_m) for each ray of a view from that pose, camera after camera. An
/// origin outside the map is taken to its nearest place inside.
template <typename Use>
void for_each_ray(const GridGeometry& geometry, const ViewRays& rays, const ViewPose& view,
                  const Use& use) {
  const Isometry T = T_world_body(view);
  for (const ViewRays::Camera& camera : rays.cameras) {
    const Vec3f origin_m = geometry.nearest_inside(T * camera.origin_body_m).cast<float>();
    const RayOrigin origin = make_ray_origin(geometry, origin_m);
    for (std::size_t i = camera.first; i < camera.first + camera.count; ++i) {
      const Vec3 end_m =
          T * Vec3(rays.end_body_m[0][i], rays.end_body_m[1][i], rays.end_body_m[2][i]);
      use(origin, Vec3f(end_m.cast<float>()));
    }
  }
}

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
void apply_slips(const GridGeometry& geometry, const RayOrigin& origin, const ReleasedSlips& slips,
                 Cast& found) {
  if (!found.hit) return;
  if (!slips.excludes_hit_voxel) {
    if (!slips.prediction_hides_hits || found.prediction_hit) found.voxels.push_back(*found.hit);
    return;
  }
  const Vec3f center_m = geometry.center_m(geometry.key_at(*found.hit)).cast<float>();
  found.voxels.clear();
  walk_ray_inside(geometry, origin, center_m, [&](VoxelIndex v) {
    found.voxels.push_back(v);
    return true;
  });
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
  for_each_ray(geometry, rays, candidate, [&](const RayOrigin& origin, const Vec3f& end_m) {
    Cast found = cast(grid, origin, end_m);
    apply_slips(geometry, origin, slips, found);
    if (found.first_predicted) predicted.push_back(*found.first_predicted);
    for (const VoxelIndex v : found.voxels) {
      const auto entropy_nat = static_cast<double>(grid.entropy_nat(v));
      stats.entropy_per_ray_nat += entropy_nat;
      if (is_seen[v]) continue;
      is_seen[v] = true;
      stats.entropy_nat += entropy_nat;
      stats.free_voxels += static_cast<std::uint32_t>(grid.state(v) == VoxelState::free);
      stats.unknown_voxels += static_cast<std::uint32_t>(grid.state(v) == VoxelState::unknown);
      if (grid.state(v) != VoxelState::occupied) continue;
      const double density = cloud.density(v);
      ++stats.occupied_voxels;
      stats.density_sum += density;
      stats.sparse_voxels += static_cast<std::uint32_t>(density > 0.0 && density < sparse_below);
    }
  });
  sort_unique(predicted);
  stats.predicted_voxels = static_cast<std::uint32_t>(predicted.size());
  return stats;
}

VoxelsInSight voxels_in_sight(const OccupancyGrid& grid, const ViewRays& rays,
                              const ViewPose& view) {
  VoxelsInSight seen;
  for_each_ray(grid.geometry(), rays, view, [&](const RayOrigin& origin, const Vec3f& end_m) {
    const Cast found = cast(grid, origin, end_m);
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
