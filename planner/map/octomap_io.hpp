// The map as OctoMap files. The only file of the planner that knows OctoMap is its .cpp.
#pragma once

#include <filesystem>
#include <vector>

#include "planner/map/occupancy_grid.hpp"

namespace gnbv {

/// Writes `stem`.ot (all log-odds) and `stem`.bt (maximum likelihood), both by rename, holding
/// every measured voxel with its exact log-odds, pruned as OctoMap prunes.
void write_octomap(const OccupancyGrid& grid, const std::filesystem::path& stem);

/// What a map file holds, whatever cubes it is pruned to.
struct MeasuredVoxels {
  double voxel_m = 0.0;
  std::vector<Vec3f> occupied_world_m = {};  // centres, in the order of the tree
  std::size_t free_voxels = 0;
};

/// Reads a .bt file. Throws BadInput naming the path when it is damaged or missing.
MeasuredVoxels read_octomap(const std::filesystem::path& bt);

}  // namespace gnbv
