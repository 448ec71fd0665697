// Maps drawn by hand.
#pragma once

#include "planner/map/occupancy_grid.hpp"

namespace gnbv {

inline bool everywhere(const Vec3&) { return true; }

/// The voxels whose centres are so.
template <typename IsSo>
std::vector<VoxelIndex> voxels_where(const OccupancyGrid& grid, const IsSo& is_so) {
  std::vector<VoxelIndex> voxels;
  for (VoxelIndex v = 0; v < grid.geometry().voxel_count(); ++v) {
    if (is_so(grid.geometry().center_m(grid.geometry().key_at(v)))) voxels.push_back(v);
  }
  return voxels;
}

inline VoxelIndex voxel_at(const OccupancyGrid& grid, const Vec3& p_world_m) {
  return grid.geometry().index_of(grid.geometry().key_of(p_world_m));
}

/// Makes voxels occupied, or free, whatever they were.
inline void hit(OccupancyGrid& grid, const std::vector<VoxelIndex>& voxels) {
  for (int i = 0; i < 20; ++i) grid.apply({.free = {}, .occupied = voxels});
}
inline void clear(OccupancyGrid& grid, const std::vector<VoxelIndex>& voxels) {
  for (int i = 0; i < 20; ++i) grid.apply({.free = voxels, .occupied = {}});
}

/// Makes the voxels with their centres in the box occupied.
inline void fill(OccupancyGrid& grid, const Box3& box_m) {
  hit(grid, voxels_where(grid, [&](const Vec3& p_m) { return box_m.contains(p_m); }));
}

/// Voxels of 0.2 m, all known to be free but those with their centres in the second box.
inline OccupancyGrid free_grid(const Box3& box_m, const Box3& filled_m = Box3()) {
  OccupancyGrid grid(OccupancyConfig{}, box_m);
  const ScanUpdate all = {.free = voxels_where(grid, everywhere), .occupied = {}};
  for (int i = 0; i < 5; ++i) grid.apply(all);
  fill(grid, filled_m);
  return grid;
}

}  // namespace gnbv
