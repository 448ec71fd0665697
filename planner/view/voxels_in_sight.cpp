#include "planner/view/voxels_in_sight.hpp"

#include <algorithm>

#include "planner/map/ray_walk.hpp"

namespace gnbv {
namespace {

void sort_unique(std::vector<VoxelIndex>& voxels) {
  std::sort(voxels.begin(), voxels.end());
  voxels.erase(std::unique(voxels.begin(), voxels.end()), voxels.end());
}

}  // namespace

VoxelsInSight voxels_in_sight(const OccupancyGrid& grid, const ViewRays& rays,
                              const ViewPose& view) {
  const GridGeometry& geometry = grid.geometry();
  const Isometry T = T_world_body(view);
  VoxelsInSight seen;
  for (const ViewRays::Camera& camera : rays.cameras) {
    const Vec3f origin_m = geometry.nearest_inside(T * camera.origin_body_m).cast<float>();
    const RayOrigin origin = make_ray_origin(geometry, origin_m);
    for (std::size_t i = camera.first; i < camera.first + camera.count; ++i) {
      const Vec3 end_m =
          T * Vec3(rays.end_body_m[0][i], rays.end_body_m[1][i], rays.end_body_m[2][i]);
      bool foresees = true;
      walk_ray_inside(geometry, origin, end_m.cast<float>(), [&](VoxelIndex v) {
        if (foresees && grid.is_predicted(v)) {
          seen.predicted.push_back(v);
          foresees = false;
        }
        if (grid.state(v) == VoxelState::unknown) seen.unknown.push_back(v);
        return grid.state(v) != VoxelState::occupied;
      });
    }
  }
  sort_unique(seen.unknown);
  sort_unique(seen.predicted);
  return seen;
}

}  // namespace gnbv
