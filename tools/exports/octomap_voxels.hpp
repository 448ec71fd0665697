// A run's map as others left it on disk: the voxels of an OctoMap file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "sim/core/pose.hpp"

namespace gnbv {

/// What a map file holds, whatever cubes it is pruned to.
struct MeasuredVoxels {
  double voxel_m = 0.0;
  std::vector<Vec3f> occupied_world_m = {};  // centres, in the order of the tree
  std::size_t free_voxels = 0;
};

/// Reads a .bt file. Throws BadInput naming the path when it is damaged or missing.
MeasuredVoxels read_octomap(const std::filesystem::path& bt);

}  // namespace gnbv
