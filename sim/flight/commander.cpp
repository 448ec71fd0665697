#include "sim/flight/commander.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace gnbv {
namespace {

struct Mode {
  NavState state;
  std::string_view name;
  std::uint32_t main;
  std::uint32_t sub = 0;  // of the Auto modes
};
constexpr std::uint32_t kAuto = 4;
constexpr std::array kModes = std::to_array<Mode>({
    // px4_custom_mode.h; in the enum's order
    {NavState::manual, "MANUAL", 1},
    {NavState::stabilized, "STABILIZED", 7},
    {NavState::altitude, "ALTITUDE", 2},
    {NavState::position, "POSITION", 3},
    {NavState::hold, "HOLD", kAuto, 3},
    {NavState::mission, "MISSION", kAuto, 4},
    {NavState::rtl, "RTL", kAuto, 5},
    {NavState::takeoff, "TAKEOFF", kAuto, 2},
    {NavState::land, "LAND", kAuto, 6},
    {NavState::offboard, "OFFBOARD", 6},
    {NavState::terminate, "TERMINATE", 10},
});

const Mode& mode_of(NavState state) { return kModes.at(static_cast<std::size_t>(state)); }

// MulticopterLandDetector.cpp: shares of the range from least to hover thrust (which is known
// here), and how much wider the limits of motion are once the vehicle may have landed
constexpr double kLowThrustShare = 0.6;
constexpr double kNoThrustShare = 0.1;
constexpr double kWidened = 2.5;

/// Whether `condition` has held for `needed_s`.
bool has_held(bool condition, double needed_s, double dt_s, double& held_s) {
  held_s = condition ? held_s + dt_s : 0.0;
  return condition && held_s > needed_s - 0.5 * dt_s;
}

using Vec2 = Eigen::Vector2d;
using Stage = AutoFlight::Stage;

constexpr double kAcceptance_m = 2.0;                // NAV_ACC_RAD
constexpr double kYawRate_rad_s = deg_to_rad(45.0);  // MPC_YAWRAUTO_MAX
constexpr double kLead_m = 0.1;         // before its trajectory: more than hovering makes
constexpr double kHomeArrival_m = 0.5;  // of RTL, before it descends and still comes nearer

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

/// Straight to the goal: the slowest of what each axis may do and what can still brake.
Vec3 velocity_to_goal(const AutoFlight& flight, const CommanderParameters& parameters) {
  const Vec3 way_m = flight.goal_world_m - each(flight, &Motion::position);
  const double distance_m = way_m.norm();
  if (distance_m < 1e-6) return Vec3::Zero();
  const Vec3 along = way_m / distance_m;
  const AxisLimits vertical = vertical_limits(parameters, along.z() > 0.0);
  const AxisLimits level = level_limits(parameters);
  const double level_m_s = flight.speed_m_s > 0.0 ? flight.speed_m_s : parameters.cruise_speed_m_s;
  const double vertical_m_s =
      along.z() > 0.0 ? parameters.climb_speed_m_s : parameters.descent_speed_m_s;
  const auto share = [](double limit, double part) { return limit / std::max(part, 1e-6); };
  const double level_part = along.head<2>().norm();
  const double vertical_part = std::abs(along.z());
  const AxisLimits both = {
      std::min(share(level.acceleration, level_part), share(vertical.acceleration, vertical_part)),
      level.jerk};
  return along * std::min({share(level_m_s, level_part), share(vertical_m_s, vertical_part),
                           braking_speed(distance_m, both)});
}

/// The velocity that the trajectory is to take up. It brakes and stays on an axis that has no goal.
Vec3 wanted_velocity(const AutoFlight& flight, const CommanderParameters& parameters,
                     double height_m) {
  if (flight.stage == Stage::go_to) return velocity_to_goal(flight, parameters);
  const Vec3 p_world_m = each(flight, &Motion::position);
  Vec3 v_m_s = Vec3::Zero();
  if (flight.stage == Stage::climb || flight.stage == Stage::go_home) {
    v_m_s.z() = speed_to_altitude_m_s(parameters, flight.mode, flight.altitude_m - p_world_m.z());
  } else if (flight.stage == Stage::land) {
    v_m_s.z() = -landing_speed_m_s(parameters, height_m);
  }
  if (flight.stage == Stage::go_home ||
      (flight.stage == Stage::land && flight.mode == NavState::rtl)) {
    const Vec2 way_m = (flight.home_world_m - p_world_m).head<2>();
    const double speed_m_s = std::min(parameters.cruise_speed_m_s,
                                      braking_speed(way_m.norm(), level_limits(parameters)));
    v_m_s.head<2>() = speed_m_s * way_m.normalized();
  }
  return v_m_s;
}

void move_trajectory(AutoFlight& flight, const CommanderParameters& parameters,
                     const Vec3& p_world_m, double dt_s) {
  const double height_m = p_world_m.z() - flight.home_world_m.z();
  const Vec3 wanted = wanted_velocity(flight, parameters, height_m);
  // the trajectory waits for a vehicle that is left behind; if it did for one that is ahead, which
  // waits for it in turn, neither would arrive (PositionSmoothing.cpp)
  const Vec2 lead_m = (p_world_m - each(flight, &Motion::position)).head<2>();
  const Vec2 v_m_s = each(flight, &Motion::speed).head<2>();
  const bool is_ahead = lead_m.dot(v_m_s) > kLead_m * v_m_s.norm();
  const double pace =
      is_ahead ? 1.0 : std::max(0.0, 1.0 - lead_m.norm() / parameters.path_error_max_m);
  const AxisLimits level = level_limits(parameters);
  flight.axes =
      advance_together(flight.axes, {wanted.x(), wanted.y(), wanted.z()},
                       {level, level, vertical_limits(parameters, wanted.z() > 0.0)}, pace * dt_s);
}

bool is_at_altitude(const AutoFlight& flight, const Vec3& p_world_m) {
  return std::abs(flight.altitude_m - p_world_m.z()) < kAltitudeArrival_m;
}

}  // namespace

std::string_view name_of(NavState state) { return mode_of(state).name; }

std::uint32_t custom_mode_of(NavState state) {
  return mode_of(state).main << 16 | mode_of(state).sub << 24;
}

std::optional<NavState> nav_state_of(long main_mode, long sub_mode) {
  if (main_mode == kAuto && sub_mode == 0) return NavState::hold;
  for (const Mode& mode : kModes) {
    const bool is_it = mode.main == main_mode && (main_mode != kAuto || mode.sub == sub_mode);
    if (is_it && mode.state != NavState::terminate) return mode.state;
  }
  return std::nullopt;
}

bool prevents_arming(NavState mode) {
  return mode == NavState::rtl || mode == NavState::land || mode == NavState::terminate;
}

bool can_run(NavState mode, double offboard_silence_s, const CommanderParameters& parameters) {
  if (mode == NavState::offboard) return offboard_silence_s < parameters.offboard_loss_s;
  return mode >= NavState::hold && mode != NavState::mission;
}

std::optional<NavState> choose_mode(NavState intention, double offboard_silence_s,
                                    const CommanderParameters& parameters) {
  if (can_run(intention, offboard_silence_s, parameters)) return intention;
  const double acts_after_s = parameters.offboard_loss_s + parameters.offboard_loss_hold_s;
  if (intention != NavState::offboard || offboard_silence_s < acts_after_s) return NavState::hold;
  constexpr std::array<std::optional<NavState>, 8> kFallbacks = {
      NavState::hold, NavState::hold, NavState::hold,  // these need a remote control
      NavState::rtl,  NavState::land, NavState::hold, NavState::terminate, std::nullopt};
  return kFallbacks.at(static_cast<std::size_t>(parameters.offboard_loss_action));
}

Takeoff next(const Takeoff& takeoff, const CommanderParameters& parameters, bool is_armed,
             bool is_landed, bool wants_takeoff, double dt_s) {
  if (!is_armed) return {};
  Takeoff after = takeoff;
  after.spooled_s += dt_s;
  if (after.phase == TakeoffPhase::disarmed) after = {TakeoffPhase::spool_up, 0.0, 0.0};
  const double half_step_s = 0.5 * dt_s;  // times are whole steps, but their sums are rounded
  if (after.phase == TakeoffPhase::spool_up &&
      after.spooled_s > parameters.spool_up_s - half_step_s) {
    after.phase = TakeoffPhase::ready;
  }
  if (after.phase == TakeoffPhase::ready && wants_takeoff) {
    after.phase = TakeoffPhase::ramp;
    after.ramp_share = 0.0;
  } else if (after.phase == TakeoffPhase::ramp) {
    const double ramp_s = parameters.takeoff_ramp_s;
    after.ramp_share = ramp_s > dt_s ? std::min(1.0, after.ramp_share + dt_s / ramp_s) : 1.0;
    if (after.ramp_share >= 1.0) after.phase = TakeoffPhase::flight;
  } else if (after.phase == TakeoffPhase::flight && is_landed) {
    after.phase = TakeoffPhase::ready;
  }
  return after;
}

double climb_limit_m_s(const Takeoff& takeoff, double gravity_m_s2, double velocity_p_per_s,
                       double climb_max_m_s) {
  if (takeoff.phase == TakeoffPhase::flight) return climb_max_m_s;
  constexpr double kGainMin = 0.01;
  const double start_m_s = -gravity_m_s2 / std::max(velocity_p_per_s, kGainMin);
  const double share = takeoff.phase == TakeoffPhase::ramp ? takeoff.ramp_share : 0.0;
  return start_m_s + share * (climb_max_m_s - start_m_s);
}

LandDetector next(const LandDetector& detector, const CommanderParameters& parameters,
                  const LandEvidence& evidence, const VehicleState& estimate, double dt_s) {
  if (!evidence.is_armed) return kOnGround;
  const double widened = detector.is_maybe_landed ? kWidened : 1.0;
  const auto thrust_below = [&](double share) {
    return evidence.thrust <=
           evidence.thrust_min + share * (evidence.hover_thrust - evidence.thrust_min);
  };
  const bool is_still =
      std::abs(estimate.v_world_m_s.z()) <= widened * parameters.land_speed_vertical_max_m_s &&
      estimate.v_world_m_s.head<2>().norm() <= parameters.land_speed_horizontal_max_m_s;
  const bool is_turning =
      estimate.omega_body_rad_s.head<2>().norm() > widened * parameters.land_rotation_max_rad_s;
  const bool may_be_down =
      evidence.is_told_to_descend || detector.is_maybe_landed || detector.is_landed;

  // a stage that was reached before is not waited for again
  const auto needed_s = [&](bool was_reached) {
    return was_reached ? 0.0 : parameters.land_detection_s / 3.0;
  };
  LandDetector after = detector;
  after.has_ground_contact = has_held(may_be_down && thrust_below(kLowThrustShare) && is_still,
                                      needed_s(detector.has_ground_contact), dt_s, after.contact_s);
  after.is_maybe_landed =
      has_held(after.has_ground_contact && thrust_below(kNoThrustShare) && !is_turning,
               needed_s(detector.is_maybe_landed), dt_s, after.maybe_s);
  after.is_landed =
      has_held(after.is_maybe_landed, needed_s(detector.is_landed), dt_s, after.landed_s);
  return after;
}

AutoFlight begin_auto(NavState mode, const CommanderParameters& parameters,
                      const VehicleState& estimate, const Vec3& home_world_m, double altitude_m) {
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
  if (returns) {  // near home no higher than a cone of 45 deg above it
    const double distance_m = (p_world_m - home_world_m).head<2>().norm();
    altitude_m = parameters.return_altitude_m;
    if (distance_m <= parameters.return_distance_min_m)
      altitude_m = std::min(altitude_m, distance_m);
  }
  flight.altitude_m = std::max(p_world_m.z(), home_world_m.z() + altitude_m);
  return flight;
}

Setpoint step_auto(AutoFlight& flight, const CommanderParameters& parameters,
                   const VehicleState& estimate, double dt_s) {
  const Vec3 p_world_m = estimate.T_world_body.translation();
  if (flight.mode == NavState::rtl) {
    const double distance_m = (flight.home_world_m - p_world_m).head<2>().norm();
    if (flight.stage == Stage::go_home && distance_m < kHomeArrival_m) flight.stage = Stage::land;
    if (flight.stage == Stage::climb && is_at_altitude(flight, p_world_m)) {
      flight.stage = Stage::go_home;
    }
  }
  move_trajectory(flight, parameters, p_world_m, dt_s);
  if (flight.stage == Stage::go_to && std::isfinite(flight.goal_yaw_rad)) {
    const double turn_rad = wrap_angle_rad(flight.goal_yaw_rad - flight.yaw_rad);
    const double step_rad = kYawRate_rad_s * dt_s;
    flight.yaw_rad = wrap_angle_rad(flight.yaw_rad + std::clamp(turn_rad, -step_rad, step_rad));
  }
  Setpoint setpoint{.p_world_m = each(flight, &Motion::position),
                    .v_world_m_s = each(flight, &Motion::speed),
                    .a_world_m_s2 = each(flight, &Motion::acceleration),
                    .yaw_rad = flight.yaw_rad};
  if (flight.stage == Stage::land) setpoint.p_world_m.z() = kNotControlled;  // ground not known
  return setpoint;
}

void go_to(AutoFlight& flight, const Vec3& goal_world_m, double yaw_rad) {
  const Vec2 way_m = (goal_world_m - each(flight, &Motion::position)).head<2>();
  const bool faces_way = std::isnan(yaw_rad) && way_m.norm() > kAcceptance_m;
  flight.stage = Stage::go_to;
  flight.goal_world_m = goal_world_m;
  flight.goal_yaw_rad = faces_way ? std::atan2(way_m.y(), way_m.x()) : yaw_rad;
}

bool is_finished(const AutoFlight& flight, const VehicleState& estimate) {
  return flight.mode == NavState::takeoff &&
         is_at_altitude(flight, estimate.T_world_body.translation());
}

}  // namespace gnbv
