// Settings of where the vehicle may be, and of how its way there is checked.
#pragma once

#include <algorithm>

#include "sim/core/pose.hpp"

namespace gnbv {

/// How the way to a view is checked: straight against the map, which holds the profile (the
/// paper); straight, or else around what blocks it (ours); or not at all (released code).
enum class PathCheck { straight, astar, unchecked };

struct PathSearchConfig {
  int max_expansions =
      2000;  // nodes that a search may look at; more in a large box: search_limit()
};

/// Defaults: section 3.1.1, and the released configuration where the paper is silent.
struct ValidityConfig {
  double collision_radius_m = 1.5;
  double z_min_m = 0.7;  // floor of the navigation box
  int recent_poses = 50;
  double recent_distance_m = 0.05;
  double recent_yaw_rad = 0.1;
  bool allow_unknown = false;  // positions in unknown space
  PathCheck path = PathCheck::straight;
  PathSearchConfig path_search = {};
};

/// The workspace, with its floor raised to z_min_m.
inline Box3 navigation_box_m(const ValidityConfig& config, const Box3& workspace_m) {
  Box3 box_m = workspace_m;
  box_m.min().z() = std::max(box_m.min().z(), config.z_min_m);
  return box_m;
}

}  // namespace gnbv
