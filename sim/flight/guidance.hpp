// Waypoint following through the setpoint interface, as an offboard companion computer would do it.
#pragma once

#include <functional>

#include "sim/core/pose.hpp"

namespace gnbv {

class Flight;
struct VehicleConfig;

/// Acceleration and arrival are those of the released vehicle_control_iris.cpp, arrival tighter.
struct GuidanceConfig {
  double path_speed_m_s = 2.0;
  double profile_speed_m_s = 1.0;
  double acceleration_m_s2 = 1.0;
  double jerk_m_s3 = 4.0;                    // MPC_JERK_AUTO
  double yaw_rate_rad_s = deg_to_rad(60.0);  // MPC_YAWRAUTO_MAX
  double yaw_acceleration_rad_s2 = deg_to_rad(120.0);
  double yaw_jerk_rad_s3 = deg_to_rad(480.0);
  double arrival_distance_m = 0.1;
  double arrival_yaw_rad = deg_to_rad(3.0);
  double arrival_speed_m_s = 0.05;
  double timeout_s = 60.0;  // beyond the time the reference itself needs
};

enum class LegEnd { arrived, timeout, collision, stopped };

/// How long the reference of such a leg takes; the vehicle arrives a little later.
double leg_duration_s(const ViewPose& from, const ViewPose& goal, double speed_m_s,
                      const GuidanceConfig& config, const VehicleConfig& vehicle);

/// Flies the straight line to `goal` at up to `speed_m_s`, turning the short way meanwhile, and
/// streams setpoints every 20 ms. Returns when the reference has come to rest and the vehicle has
/// arrived (position, yaw and speed), on contact, or on timeout; the last setpoint stays in force.
/// Where the vehicle is, is what its estimate says. `vehicle` is what flies: a quadrotor is led no
/// faster than at 80 % of its autopilot's own limits, and with the feed-forward of its kind.
/// `on_tick` (may be empty) is called after every tick: sensors that run in flight hook in there;
/// when it returns false the leg ends as `stopped`.
LegEnd fly_leg(Flight& flight, const ViewPose& goal, double speed_m_s, const GuidanceConfig& config,
               const VehicleConfig& vehicle, const std::function<bool(const Flight&)>& on_tick);

}  // namespace gnbv
