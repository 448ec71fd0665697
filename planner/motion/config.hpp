// Where the vehicle may be and how its way there is checked: settings, and boxes to keep out of.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "sim/core/pose.hpp"
#include "sim/core/rest_to_rest.hpp"

namespace gnbv {

/// How the way to a view is checked: straight against the map, which holds the profile (the
/// paper); straight, or else around what blocks it (ours); or not at all (released code).
enum class PathCheck { straight, astar, unchecked };

struct PathSearchConfig {
  /// Nodes that a search may look at in a navigation box of up to 40,000 nodes; in a larger one as
  /// many times more.
  int max_expansions = 2000;
};

/// Defaults: section 3.1.1, and the released configuration where the paper is silent.
struct ValidityConfig {
  double collision_radius_m = 1.5;
  double leg_radius_m = 0.0;  // of the sphere that a straight way has to leave room for; 0: that
  double z_min_m = 0.7;       // floor of the navigation box
  int recent_poses = 50;
  double recent_distance_m = 0.05;
  double recent_yaw_rad = 0.1;
  bool allow_unknown = false;  // positions in unknown space
  PathCheck path = PathCheck::straight;
  PathSearchConfig path_search = {};
};

inline double leg_radius_m(const ValidityConfig& config) {
  return config.leg_radius_m > 0.0 ? config.leg_radius_m : config.collision_radius_m;
}

/// The workspace, with its floor raised to z_min_m.
inline Box3 navigation_box_m(const ValidityConfig& config, const Box3& workspace_m) {
  Box3 box_m = workspace_m;
  box_m.min().z() = std::max(box_m.min().z(), config.z_min_m);
  return box_m;
}

/// Boxes where nobody may fly, which no sensor sees. World ENU. The vehicle's sphere keeps out of
/// them as it does of occupied voxels.
struct NoFly {
  std::vector<Box3> boxes_m = {};
  double margin_m = 0.0;  // radius of the sphere

  /// Whether the sphere is clear of all boxes.
  bool allows(const Vec3& p_world_m) const;
  /// Whether it is on the whole straight leg. A box that the sphere reaches into at the start may
  /// be left but not approached.
  bool allows_leg(const Vec3& from_world_m, const Vec3& to_world_m) const;
};

/// How fast the vehicle flies and turns, as far as a planner counts on it.
struct TravelConfig {
  double speed_m_s = 2.0;
  double yaw_rate_rad_s = deg_to_rad(60.0);
  double yaw_acceleration_rad_s2 = deg_to_rad(120.0);

  /// A way that is not turned off: the mean speed is 0.9 of the top speed.
  double way_s(double way_m) const { return way_m / (0.9 * speed_m_s); }
  /// From rest to rest.
  double turn_s(double turn_rad) const {
    return rest_to_rest_s(std::abs(turn_rad), yaw_rate_rad_s, yaw_acceleration_rad_s2);
  }
  /// Both at once.
  double leg_s(double way_m, double turn_rad) const {
    return std::max(way_s(way_m), turn_s(turn_rad));
  }
};

/// Asked several times a second by what may take long: throws to end it. Empty: nobody asks.
using HeedStop = std::function<void()>;
inline void heed(const HeedStop& stop) {
  if (stop) stop();
}

}  // namespace gnbv
