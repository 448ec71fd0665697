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

/// Fills `found`, reusing its memory. Behind a hit only the prediction is of interest.
void cast(const OccupancyGrid& grid, const RayOrigin& origin, const Vec3f& end_m, Cast& found) {
  const bool any_predicted = grid.predicted_count() > 0;
  found.voxels.clear();
  found.hit = found.first_predicted = std::nullopt;
  found.prediction_hit = false;
  walk_ray_inside(grid.geometry(), origin, end_m, [&](VoxelIndex v) {
    found.prediction_hit |= grid.is_predicted(v);
    if (found.hit) return any_predicted && !found.prediction_hit;
    if (grid.is_predicted(v) && !found.first_predicted) found.first_predicted = v;
    if (grid.state(v) == VoxelState::occupied) {
      found.hit = v;
    } else {
      found.voxels.push_back(v);
    }
    return true;
  });
}

/// Calls use(found, origin, end) for each ray of a view from that pose, camera after camera. An
/// origin outside the map is taken to its nearest place inside.
template <typename Use>
void cast_each(const OccupancyGrid& grid, const ViewRays& rays, const ViewPose& view,
               const Use& use) {
  const GridGeometry& geometry = grid.geometry();
  const Isometry T = T_world_body(view);
  const auto& [x_m, y_m, z_m] = rays.end_body_m;
  Cast found;
  for (const ViewRays::Camera& camera : rays.cameras) {
    const Vec3f origin_m = geometry.nearest_inside(T * camera.origin_body_m).cast<float>();
    const RayOrigin origin = make_ray_origin(geometry, origin_m);
    for (std::size_t i = camera.first; i < camera.first + camera.count; ++i) {
      const Vec3 end_m = T * Vec3(x_m[i], y_m[i], z_m[i]);
      cast(grid, origin, end_m.cast<float>(), found);
      use(found, origin, end_m);
    }
  }
}

/// Makes the voxels of the ray those that count, with the slips.
void list_counted(const GridGeometry& geometry, const RayOrigin& origin, const ReleasedSlips& slips,
                  Cast& found) {
  if (!found.hit) return;
  if (slips.excludes_hit_voxel || slips.prediction_hides_hits) {
    const Vec3f center_m = geometry.center_m(geometry.key_at(*found.hit)).cast<float>();
    found.voxels.clear();
    walk_ray_inside(geometry, origin, center_m, [&](VoxelIndex v) {
      found.voxels.push_back(v);
      return true;
    });
  }
  const bool is_hidden = slips.prediction_hides_hits && !found.prediction_hit;
  if (!slips.excludes_hit_voxel && !is_hidden) found.voxels.push_back(*found.hit);
}

/// Whether the ray, up to what it hits, ends outside the object bounds or the map.
bool leaves_bounds(const OccupancyGrid& grid, const Cast& found, const Vec3& end_m) {
  if (found.hit) return !grid.is_counted(*found.hit);
  const Key key = grid.geometry().key_of(end_m);
  return !grid.geometry().contains(key) || !grid.is_counted(grid.geometry().index_of(key));
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
  cast_each(grid, rays, candidate, [&](Cast& found, const RayOrigin& origin, const Vec3& end_m) {
    if (found.first_predicted) predicted.push_back(*found.first_predicted);
    const bool is_dropped = slips.drops_leaving_rays && leaves_bounds(grid, found, end_m);
    list_counted(geometry, origin, slips, found);
    for (const VoxelIndex v : found.voxels) {
      const double entropy_nat = grid.entropy_nat(v);
      if (!is_dropped) stats.entropy_per_ray_nat += entropy_nat;
      if (!grid.is_counted(v)) continue;
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
  cast_each(grid, rays, view, [&](const Cast& found, const RayOrigin&, const Vec3&) {
    if (found.first_predicted) seen.predicted.push_back(*found.first_predicted);
    for (const VoxelIndex v : found.voxels) {
      const bool is_unknown = grid.state(v) == VoxelState::unknown;
      if (is_unknown && grid.is_counted(v)) seen.unknown.push_back(v);
    }
  });
  sort_unique(seen.unknown);
  sort_unique(seen.predicted);
  return seen;
}

}  // namespace gnbv
