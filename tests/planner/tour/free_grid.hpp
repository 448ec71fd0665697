// A map without anything in it, known to be free.
#pragma once

#include "planner/map/occupancy_grid.hpp"

namespace gnbv {

/// Voxels of 0.2 m.
inline OccupancyGrid free_grid(const Box3& box_m) {
  OccupancyConfig config;
  config.resolution_m = 0.2;
  OccupancyGrid grid(config, box_m);
  std::vector<VoxelIndex> all(grid.geometry().voxel_count());
  for (VoxelIndex v = 0; v < all.size(); ++v) all[v] = v;
  for (int i = 0; i < 5; ++i) grid.apply({.free = all, .occupied = {}});
  return grid;
}

/// Makes the voxels with their centres in the box occupied.
inline void fill(OccupancyGrid& grid, const Box3& box_m) {
  std::vector<VoxelIndex> voxels;
  for (VoxelIndex v = 0; v < grid.geometry().voxel_count(); ++v) {
    if (box_m.contains(grid.geometry().center_m(grid.geometry().key_at(v)))) voxels.push_back(v);
  }
  for (int i = 0; i < 20; ++i) grid.apply({.free = {}, .occupied = voxels});
}

}  // namespace gnbv
