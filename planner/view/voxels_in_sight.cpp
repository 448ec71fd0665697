#include "planner/view/voxels_in_sight.hpp"

#include <algorithm>

#include "planner/view/each_ray.hpp"

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
  VoxelsInSight seen;
  for_each_ray(geometry, rays, view, [&](const RayOrigin& origin, const Vec3f& end_m) {
    bool foresees = true;
    walk_ray_inside(geometry, origin, end_m, [&](VoxelIndex v) {
      if (foresees && grid.is_predicted(v)) {
        seen.predicted.push_back(v);
        foresees = false;
      }
      if (grid.state(v) == VoxelState::unknown) seen.unknown.push_back(v);
      return grid.state(v) != VoxelState::occupied;
    });
  });
  sort_unique(seen.unknown);
  sort_unique(seen.predicted);
  return seen;
}

}  // namespace gnbv
