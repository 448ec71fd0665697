// Where the vehicle may be: voxels known to be free, with no occupied one within its radius and
// none where nobody may fly.
#pragma once

#include <cstdint>
#include <vector>

#include "planner/map/occupancy_grid.hpp"
#include "planner/motion/no_fly.hpp"
#include "sim/core/zeroed_array.hpp"

namespace gnbv {

class OpenSpace {
 public:
  OpenSpace(const GridGeometry& geometry, const Box3& navigation_m, const NoFly& no_fly,
            double radius_m);

  /// Takes up what became occupied since the last call, or ceased to be.
  void follow(const OccupancyGrid& grid);

  /// Whether the vehicle may stand in the middle of the voxel: is_sphere_clear, but a cube at the
  /// radius to within rounding is near.
  bool is_open(const OccupancyGrid& grid, const Key& key) const;
  /// Whether all voxels that the line crosses are open; those about the start, up to the first open
  /// one, need only be free: it may have been seen from there that the start is too near.
  bool is_line_open(const OccupancyGrid& grid, const Vec3& from_world_m,
                    const Vec3& to_world_m) const;

 private:
  GridGeometry geometry_;
  Box3 navigation_m_;
  double radius_m_;
  std::vector<Key> ball_;                     // offsets at which an occupied voxel is too near
  ZeroedArray<std::uint32_t> near_occupied_;  // so many, and one more where nobody may fly
  ZeroedArray<std::uint8_t> was_occupied_;
};

}  // namespace gnbv
