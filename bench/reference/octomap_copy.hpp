// What the twins on OctoMap's own tree share. Included by them alone: it brings OctoMap along.
#pragma once

#include <octomap/octomap.h>

#include "planner/map/occupancy_grid.hpp"
#include "planner/view/visibility.hpp"

namespace gnbv {

/// OctoMap's keys are ours plus this.
constexpr int kOctomapKeyOffset = 32768;

inline Key our_key(const octomap::OcTreeKey& key) {
  return {key[0] - kOctomapKeyOffset, key[1] - kOctomapKeyOffset, key[2] - kOctomapKeyOffset};
}

inline octomap::OcTreeKey octomap_key(const Key& key) {
  return {static_cast<octomap::key_type>(key[0] + kOctomapKeyOffset),
          static_cast<octomap::key_type>(key[1] + kOctomapKeyOffset),
          static_cast<octomap::key_type>(key[2] + kOctomapKeyOffset)};
}

inline octomap::point3d octomap_point(const Vec3f& p_m) { return {p_m.x(), p_m.y(), p_m.z()}; }

/// Makes the tree one of what the grid has measured, with its threshold of occupancy. Requires an
/// empty tree of the grid's resolution.
inline void copy_into(const OccupancyGrid& grid, octomap::OcTree& octree) {
  octree.setOccupancyThres(grid.config().occupied_min);
  const auto voxels = static_cast<VoxelIndex>(grid.geometry().voxel_count());
  for (VoxelIndex v = 0; v < voxels; ++v) {
    if (!grid.is_measured(v)) continue;
    constexpr bool kLazy = true;
    octree.setNodeValue(octomap_key(grid.geometry().key_at(v)), grid.log_odds(v), kLazy);
  }
  octree.updateInnerOccupancy();
}

/// Calls visit(origin_world_m, end_world_m) for every ray of a candidate.
template <typename Visit>
void for_each_ray(const GridGeometry& grid, const ViewRays& rays, const ViewPose& candidate,
                  Visit&& visit) {
  const Isometry T = T_world_body(candidate);
  for (const ViewRays::Camera& camera : rays.cameras) {
    const Vec3 origin_m = grid.nearest_inside(T * camera.origin_body_m);
    for (std::size_t i = camera.first; i < camera.first + camera.count; ++i) {
      visit(origin_m,
            T * Vec3(rays.end_body_m[0][i], rays.end_body_m[1][i], rays.end_body_m[2][i]));
    }
  }
}

}  // namespace gnbv
