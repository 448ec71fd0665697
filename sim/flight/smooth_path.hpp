// A way that passes poses without stopping at them, within limits on speed, acceleration and jerk.
#pragma once

#include <span>
#include <vector>

#include "sim/core/pose.hpp"

namespace gnbv {

struct GuidanceConfig;
struct VehicleConfig;

/// Between two references of a way, in seconds: a setpoint each.
constexpr double kReference_s = 0.02;

/// A pose that a way passes.
struct PassedPose {
  ViewPose pose;
  bool needs_yaw = true;  // false: a point on the way, turned as it happens
};

/// Where the vehicle is to be at one moment, and how it is to move.
struct Reference {
  Vec3 p_world_m = Vec3::Zero();
  Vec3 v_world_m_s = Vec3::Zero();
  Vec3 a_world_m_s2 = Vec3::Zero();
  double yaw_rad = 0.0;
  double yaw_rate_rad_s = 0.0;
  double yaw_acceleration_rad_s2 = 0.0;
  std::size_t passed = 0;  // poses of its way
};

/// The way from a moment on to the last of the poses, where it comes to rest: a reference every
/// kReference_s, the first one step after `from`. A pose is passed when the way is as near to it
/// as GuidanceConfig::pass_distance_m and pass_yaw_rad allow. At each step:
/// - the speed towards the next pose is the highest from which the vehicle can still turn off to
///   the one after it, sqrt(a r / tan(turn / 2)), and brake in time for all that follow (PX4,
///   TrajMath.hpp: computeXYSpeedFromWaypoints), and at which the heading is there in time, too;
/// - velocity follows within limits on acceleration and jerk as vectors, with the square-root law
///   that ends a change without overshoot (ArduPilot, AP_Math/control.cpp: shape_vel_accel_xy).
/// Empty where it would take longer than kLongestWay_s: limits that do not allow it.
std::vector<Reference> smooth_path(const Reference& from, std::span<const PassedPose> poses,
                                   double speed_m_s, const GuidanceConfig& config,
                                   const VehicleConfig& vehicle);
constexpr double kLongestWay_s = 600.0;

}  // namespace gnbv
