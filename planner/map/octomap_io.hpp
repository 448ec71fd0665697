// The map as OctoMap files. The only file of the planner that knows OctoMap is its .cpp.
#pragma once

#include <filesystem>

#include "planner/map/occupancy_grid.hpp"

namespace gnbv {

/// Writes `stem`.ot (all log-odds) and `stem`.bt (maximum likelihood), both by rename, holding
/// every measured voxel with its exact log-odds, pruned as OctoMap prunes.
void write_octomap(const OccupancyGrid& grid, const std::filesystem::path& stem);

}  // namespace gnbv
