// Places off the lattice, chosen from the surface: for patches that no place of the lattice sees.
#pragma once

#include <cstdint>
#include <set>
#include <span>
#include <vector>

#include "planner/tour/open_space.hpp"
#include "planner/tour/patches.hpp"
#include "sensors/camera_model.hpp"

namespace gnbv {

/// What places are looked for in.
struct PlaceSearch {
  const OccupancyGrid& grid;
  const OpenSpace& space;
  std::span<const CameraModel> cameras;
};

/// The best `most` places from which some camera, turned to the patch by the vehicle's yaw, would
/// have it in its image with no occupied voxel in between: the more it is seen face on and from
/// nearby, the better. Tries bearings within 60 deg of the normal's, what elevations each camera
/// has, and four distances up to its range.
std::vector<Vec3> places_to_see(const PlaceSearch& search, const Patch& patch, std::size_t most);

/// Places for what none sees: two for each of the cubes of a metre that lack the most, as far as
/// they have not been tried, at most 24 cubes a call. `is_seen`: of each patch.
std::vector<Vec3> places_for_unseen(const PlaceSearch& search, std::span<const Patch> patches,
                                    std::span<const std::uint8_t> is_seen, std::set<Key>& tried);

}  // namespace gnbv
