#include "sim/flight/auto_modes.hpp"

#include <algorithm>
#include <cmath>

namespace gnbv {
namespace {

using Vec2 = Eigen::Vector2d;
using Stage = AutoFlight::Stage;

constexpr double kAltitudeArrival_m = 0.8;  // NAV_MC_ALT_RAD; the rest of the way is flown as well
constexpr double kHomeArrival_m = 0.5;      // of RTL, before it descends and still comes nearer

/// Near home RTL climbs no higher than a cone of 45 deg above it.
double return_altitude_m(const CommanderParameters& parameters, double distance_m) {
  if (distance_m > parameters.return_distance_min_m) return parameters.return_altitude_m;
  return std::min(parameters.return_altitude_m, distance_m);
}

/// MPC_Z_V_AUTO_DN far above the ground, MPC_LAND_SPEED near it.
double landing_speed_m_s(const CommanderParameters& parameters, double height_m) {
  const double range_m = parameters.land_slow_from_m - parameters.land_slow_below_m;
  const double above_m = height_m - parameters.land_slow_below_m;
  const double share =
      range_m > 0.0 ? std::clamp(above_m / range_m, 0.0, 1.0) : (above_m > 0.0 ? 1.0 : 0.0);
  return parameters.land_speed_m_s +
         share * (parameters.descent_speed_m_s - parameters.land_speed_m_s);
}

AxisLimits level_limits(const CommanderParameters& parameters) {
  return {parameters.acceleration_m_s2, parameters.jerk_m_s3};
}

AxisLimits vertical_limits(const CommanderParameters& parameters, bool is_upwards) {
  return {is_upwards ? parameters.acceleration_up_m_s2 : parameters.acceleration_down_m_s2,
          parameters.jerk_m_s3};
}

double speed_to_altitude_m_s(const CommanderParameters& parameters, NavState mode, double rise_m) {
  const bool is_upwards = rise_m > 0.0;
  double limit_m_s = is_upwards ? parameters.climb_speed_m_s : parameters.descent_speed_m_s;
  if (mode == NavState::takeoff) limit_m_s = std::min(limit_m_s, parameters.takeoff_speed_m_s);
  const double speed_m_s = braking_speed(std::abs(rise_m), vertical_limits(parameters, is_upwards));
  return std::copysign(std::min(speed_m_s, limit_m_s), rise_m);
}

/// One of the three numbers of each axis.
Vec3 each(const AutoFlight& flight, double Motion::*number) {
  return {flight.axes[0].*number, flight.axes[1].*number, flight.axes[2].*number};
}

/// The velocity that the trajectory is to take up. It brakes and stays on an axis that has no goal.
Vec3 wanted_velocity(const AutoFlight& flight, const CommanderParameters& parameters,
                     double height_m) {
  const Vec3 p_world_m = each(flight, &Motion::position);
  Vec3 v_m_s = Vec3::Zero();
  if (flight.stage == Stage::climb || flight.stage == Stage::go_home) {
    v_m_s.z() = speed_to_altitude_m_s(parameters, flight.mode, flight.altitude_m - p_world_m.z());
  } else if (flight.stage == Stage::land) {
    v_m_s.z() = -landing_speed_m_s(parameters, height_m);
  }
  if (flight.stage == Stage::go_home ||
      (flight.stage == Stage::land && flight.mode == NavState::rtl)) {
    const Vec2 way_m = flight.home_world_m - p_world_m.head<2>();
    const double speed_m_s = std::min(parameters.cruise_speed_m_s,
                                      braking_speed(way_m.norm(), level_limits(parameters)));
    v_m_s.head<2>() = speed_m_s * way_m.normalized();
  }
  return v_m_s;
}

void move_trajectory(AutoFlight& flight, const CommanderParameters& parameters,
                     const Vec3& p_world_m, double dt_s) {
  const Vec3 wanted = wanted_velocity(flight, parameters, p_world_m.z());
  // the trajectory waits for a vehicle that is left behind
  const double error_m = (each(flight, &Motion::position) - p_world_m).head<2>().norm();
  const double pace = std::max(0.0, 1.0 - error_m / parameters.path_error_max_m);
  const AxisLimits level = level_limits(parameters);
  flight.axes =
      advance_together(flight.axes, {wanted.x(), wanted.y(), wanted.z()},
                       {level, level, vertical_limits(parameters, wanted.z() > 0.0)}, pace * dt_s);
}

bool is_at_altitude(const AutoFlight& flight, const Vec3& p_world_m) {
  return std::abs(flight.altitude_m - p_world_m.z()) < kAltitudeArrival_m;
}

void enter_next_stage_of_return(AutoFlight& flight, const Vec3& p_world_m) {
  if (flight.stage == Stage::climb && is_at_altitude(flight, p_world_m)) {
    flight.stage = Stage::go_home;
  } else if (flight.stage == Stage::go_home &&
             (flight.home_world_m - p_world_m.head<2>()).norm() < kHomeArrival_m) {
    flight.stage = Stage::land;
  }
}

}  // namespace

AutoFlight begin_auto(NavState mode, const CommanderParameters& parameters,
                      const VehicleState& estimate, const Eigen::Vector2d& home_world_m,
                      double altitude_m) {
  const Vec3 p_world_m = estimate.T_world_body.translation();
  const bool returns = mode == NavState::rtl;
  AutoFlight flight{.stage = returns || mode == NavState::takeoff ? Stage::climb
                             : mode == NavState::land             ? Stage::land
                                                                  : Stage::hold,
                    .mode = mode,
                    .axes = {},
                    .yaw_rad = yaw_of(estimate.T_world_body),
                    .home_world_m = home_world_m};
  for (int i = 0; i < 3; ++i) {
    flight.axes[static_cast<std::size_t>(i)] = {p_world_m[i], estimate.v_world_m_s[i], 0.0};
  }
  const double distance_m = (p_world_m.head<2>() - home_world_m).norm();
  flight.altitude_m =
      std::max(p_world_m.z(), returns ? return_altitude_m(parameters, distance_m) : altitude_m);
  return flight;
}

Setpoint step_auto(AutoFlight& flight, const CommanderParameters& parameters,
                   const VehicleState& estimate, double dt_s) {
  const Vec3 p_world_m = estimate.T_world_body.translation();
  if (flight.mode == NavState::rtl) enter_next_stage_of_return(flight, p_world_m);
  move_trajectory(flight, parameters, p_world_m, dt_s);
  Setpoint setpoint{.p_world_m = each(flight, &Motion::position),
                    .v_world_m_s = each(flight, &Motion::speed),
                    .a_world_m_s2 = each(flight, &Motion::acceleration),
                    .yaw_rad = flight.yaw_rad};
  if (flight.stage == Stage::land) setpoint.p_world_m.z() = kNotControlled;  // ground not known
  return setpoint;
}

bool is_finished(const AutoFlight& flight, const VehicleState& estimate) {
  return flight.mode == NavState::takeoff &&
         is_at_altitude(flight, estimate.T_world_body.translation());
}

}  // namespace gnbv
