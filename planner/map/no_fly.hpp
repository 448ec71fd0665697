// Where a mission may not fly: boxes that the planner is told of, which no sensor sees.
#pragma once

#include <functional>
#include <optional>
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

/// A shortest way by corners of the boxes grown by the margin, inside the navigation box (Dijkstra
/// 1959 on the visibility graph of these): the points between the ends, none where the straight leg
/// will do. `is_clear` may forbid further legs. Nothing where there is no such way. Deterministic:
/// of equally short ways the one by the corner of the lower number.
std::optional<std::vector<Vec3>> way_around(
    const NoFly& no_fly, const Box3& navigation_m, const Vec3& from_world_m, const Vec3& to_world_m,
    const std::function<bool(const Vec3& from_m, const Vec3& to_m)>& is_clear = {});

}  // namespace gnbv
