// Waypoint following through the setpoint interface, as an offboard companion computer would do it.
#pragma once

#include <functional>

#include "sim/flight.hpp"

namespace gnbv {

/// The acceleration setpoint sent along with position and velocity, which spares the autopilot's
/// integrators: gain * acceleration + drag * velocity. Defaults for the Iris of vehicle_config.hpp
/// under its autopilot.
struct FeedForward {
  double gain_xy = 1.2;          // 1 + MPC_XY_VEL_D_ACC, which brakes any acceleration
  double drag_xy_per_s = 0.364;  // 4 rotors * hover speed * drag coefficient / mass
  double gain_z = 0.571;         // PX4 takes thrust for proportional to the command u, but it grows
                                 // with (0.1 + u)^2: 2 u / (0.1 + u) = 1.75 times faster at hover
  double drag_z_per_s = 0.224;   // thrust lost along the axis, up or down: gain_z * g / (25 m/s)
  double attitude_lag_s = 0.12;  // from the acceleration setpoint to the tilt
};

/// Arrival as in the released vehicle_control_iris.cpp, but tighter. The acceleration lies between
/// that file's braking (v^2 = |e| a / 2 with a = 1, that is 0.25) and PX4's Auto limit of 3.
struct GuidanceConfig {
  double path_speed_m_s = 2.0;
  double profile_speed_m_s = 1.0;
  double climb_speed_max_m_s = 2.5;    // below MPC_Z_VEL_MAX_UP 3 and MPC_Z_VEL_MAX_DN 1.5, so that
  double descent_speed_max_m_s = 1.2;  // the position loop has room to correct; slows the whole leg
  double acceleration_m_s2 = 0.6;
  double yaw_rate_rad_s = deg_to_rad(60.0);  // MPC_YAWRAUTO_MAX
  double yaw_acceleration_rad_s2 = deg_to_rad(120.0);
  double smoothing_s = 0.5;  // every change of acceleration takes this long
  FeedForward feed_forward;
  double arrival_distance_m = 0.1;
  double arrival_yaw_rad = deg_to_rad(3.0);
  double arrival_speed_m_s = 0.05;
  double timeout_s = 60.0;  // beyond the time the reference itself needs
};

enum class LegEnd { arrived, timeout, collision, stopped };

/// Flies the straight line to `goal` at up to `speed_m_s`, turning the short way meanwhile, and
/// streams setpoints every 20 ms. Returns when the reference has come to rest and the vehicle has
/// arrived (position, yaw and speed), on contact, or on timeout; the last setpoint stays in force.
/// Where the vehicle is, is what its estimate says. `on_tick` (may be empty) is called after every
/// tick: sensors that run in flight hook in there; when it returns false the leg ends as `stopped`.
LegEnd fly_leg(Flight& flight, const ViewPose& goal, double speed_m_s, const GuidanceConfig& config,
               const std::function<bool(const Flight&)>& on_tick);

}  // namespace gnbv
