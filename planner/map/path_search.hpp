// A way around what blocks the straight path.
#pragma once

#include <optional>
#include <vector>

#include "planner/map/config.hpp"
#include "planner/map/no_fly.hpp"
#include "planner/map/occupancy_grid.hpp"

namespace gnbv {

/// A* (Hart, Nilsson, Raphael 1968) on a lattice through `from` with a step of the radius (at
/// least a voxel), 26 neighbours a node, through voxels known to be free, the sphere clear all the
/// way and inside the navigation box; then straightened greedily. Returns the points between the
/// ends: none when the straight path will do. Nothing where no way was found. Deterministic: of
/// equal nodes the one found first is expanded first. No leg of it is one that `no_fly` forbids.
/// `allow_unknown`: through unknown voxels, too.
std::optional<std::vector<Vec3>> find_path(const PathSearchConfig& config,
                                           const OccupancyGrid& grid, const Box3& navigation_m,
                                           const Vec3& from_world_m, const Vec3& to_world_m,
                                           double radius_m, const NoFly& no_fly = {},
                                           bool allow_unknown = false);

/// Length of the way from one end by the points between them to the other.
double path_length_m(const Vec3& from_world_m, std::span<const Vec3> via_world_m,
                     const Vec3& to_world_m);

}  // namespace gnbv
