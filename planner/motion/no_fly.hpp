// Where a mission may not fly: boxes that the planner is told of, which no sensor sees.
#pragma once

#include <vector>

#include "sim/core/pose.hpp"

namespace gnbv {

/// World ENU. The collision sphere keeps out of the boxes as it does of occupied voxels.
struct NoFly {
  std::vector<Box3> boxes_m = {};
  double margin_m = 0.0;  // radius of the sphere

  /// Whether the sphere is clear of all boxes.
  bool allows(const Vec3& p_world_m) const;
  /// Whether it is on the whole straight leg. A box that it reaches into at the start already, as
  /// one that drifted there may, can be left but not approached.
  bool allows_leg(const Vec3& from_world_m, const Vec3& to_world_m) const;
};

}  // namespace gnbv
