// The map as OctoMap files. The only file of the planner that knows OctoMap is its .cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "planner/map/occupancy_grid.hpp"

namespace gnbv {

/// Writes `stem`.ot (all log-odds) and `stem`.bt (maximum likelihood), both by rename, holding
/// every measured voxel with its exact log-odds, pruned as OctoMap prunes.
void write_octomap(const OccupancyGrid& grid, const std::filesystem::path& stem);

/// A cube of voxels that agree.
struct OctomapLeaf {
  Key first;  // its lowest voxel
  std::int32_t edge_voxels = 1;
  float log_odds = 0.0F;
};

struct OctomapLeaves {
  double voxel_m = 0.0;
  std::vector<OctomapLeaf> leaves;  // in the order of the tree
};

/// Whether it is occupied by those thresholds.
bool is_occupied(const OctomapLeaf& leaf, const OccupancyConfig& config);

/// The measured space of an OcTree or ColorOcTree, .ot or .bt by content, anybody's. Throws
/// BadInput naming the file that is none, is of another tree, cut short or damaged.
OctomapLeaves read_octomap(const std::filesystem::path& path);

}  // namespace gnbv
