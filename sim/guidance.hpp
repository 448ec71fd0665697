// Waypoint following through the setpoint interface, as an offboard companion computer would do it.
#pragma once

#include <functional>

#include "sim/flight.hpp"

namespace gnbv {

/// Defaults: the released vehicle_control_iris.cpp (arrival) and PX4's Auto limits (acceleration).
struct GuidanceConfig {
  double speed_m_s = 2.0;
  double profile_speed_m_s = 1.0;
  double acceleration_m_s2 = 1.0;
  double yaw_rate_rad_s = deg_to_rad(60.0);
  double arrival_distance_m = 0.1;
  double arrival_yaw_rad = deg_to_rad(3.0);
  double arrival_speed_m_s = 0.05;
  double timeout_s = 60.0;             // beyond the time the reference itself needs
};

enum class LegEnd { arrived, timeout, collision };

/// Flies the straight line to `goal` at up to `speed_m_s`, streaming setpoints every 20 ms, and
/// returns when arrived (position, yaw and speed), on contact, or on timeout. `on_tick` is called
/// after every tick: sensors that run in flight hook in there.
LegEnd fly_leg(Flight& flight, const ViewPose& goal, double speed_m_s, const GuidanceConfig& config,
               const std::function<void(const Flight&)>& on_tick);

}  // namespace gnbv
