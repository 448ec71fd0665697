// Nodes off the lattice, chosen from the surface: for patches that no node of the lattice sees.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "planner/motion/open_space.hpp"
#include "planner/tour/patches.hpp"
#include "sensors/camera_model.hpp"

namespace gnbv {

/// What nodes are looked for in.
struct NodeSearch {
  const OccupancyGrid& grid;
  const OpenSpace& space;
  std::span<const CameraModel> cameras;
};

/// The best `most` points from which some camera, turned to the patch by the vehicle's yaw, would
/// have it in its image with no occupied voxel in between: the more it is seen face on and from
/// nearby, the better. Tries bearings within 60 deg of the normal's, what elevations each camera
/// has, and four distances up to its range.
std::vector<Vec3> points_to_see(const NodeSearch& search, const Patch& patch, std::size_t most);

/// Cubes of a metre that were searched for: how often without finding a point, -1 where one was
/// found.
using SearchedCubes = std::map<Key, int>;

/// Points for what none sees: two for each of the cubes of a metre that lack the most, at most 24
/// cubes a call. A cube for which none is found may be searched again, when space has opened, after
/// all others. `is_seen`: of each patch.
std::vector<Vec3> points_for_unseen(const NodeSearch& search, std::span<const Patch> patches,
                                    std::span<const std::uint8_t> is_seen, SearchedCubes& searched);

}  // namespace gnbv
