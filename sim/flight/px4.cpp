#include "sim/flight/px4.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gnbv {
namespace {

constexpr double kTakeoffSetpointAge_s = 1.0;  // older setpoints start no takeoff
constexpr double kTiltLimitSlew_rad_s = 0.2;   // MulticopterPositionControl.hpp
// on the ramp MPC_THR_MIN does not bind yet; not zero, so that the thrust keeps a direction
constexpr double kRampThrustMin = 1e-3;

bool is_auto(NavState mode) {
  return mode == NavState::hold || mode == NavState::takeoff || mode == NavState::land ||
         mode == NavState::rtl || mode == NavState::descend;
}

/// Level at the present heading.
AttitudeSetpoint idle(const VehicleState& estimate, double thrust) {
  AttitudeSetpoint setpoint;
  setpoint.q_world_body = Eigen::AngleAxisd(yaw_of(estimate.T_world_body), Vec3::UnitZ());
  setpoint.thrust = thrust;
  return setpoint;
}

}  // namespace

Px4::Px4(const AutopilotParameters& parameters, const AirframeParameters& airframe,
         const VehicleState& start, Start how)
    : parameters_(parameters),
      airframe_(airframe),
      allocation_(allocation_of(airframe)),
      estimate_(start),
      home_world_m_(start.T_world_body.translation().head<2>()),
      tilt_limit_rad_(parameters.commander.tilt_max_on_ground_rad) {
  if (how == Start::on_ground) return;
  intention_ = intention_after_disarming_ = nav_state_ = NavState::offboard;
  is_armed_ = has_flown_ = true;
  takeoff_.phase = TakeoffPhase::flight;
  land_ = LandDetector{};
  tilt_limit_rad_ = parameters.tilt_max_rad;
  offboard_setpoint_.p_world_m = start.T_world_body.translation();
  offboard_setpoint_.yaw_rad = yaw_of(start.T_world_body);
  heartbeat_tick_ = 0;
}

std::int64_t Px4::tick() const { return tick_; }
NavState Px4::nav_state() const { return nav_state_; }
NavState Px4::intention() const { return intention_; }
bool Px4::is_armed() const { return is_armed_; }
bool Px4::is_landed() const { return land_.is_landed; }
bool Px4::is_in_failsafe() const { return is_in_failsafe_; }
const AttitudeSetpoint& Px4::attitude_setpoint() const { return attitude_setpoint_; }
std::vector<StatusText> Px4::take_messages() { return std::exchange(messages_, {}); }

void Px4::say(int severity, std::string text) { messages_.push_back({severity, std::move(text)}); }

void Px4::offboard_setpoint(const Setpoint& setpoint) {
  const bool is_invalid = !is_valid(setpoint);
  if (!is_invalid) heartbeat_tick_ = tick_;
  if (nav_state_ != NavState::offboard) return;
  offboard_setpoint_ = setpoint;
  const bool has_warned = std::exchange(has_warned_of_setpoint_, is_invalid);
  if (is_invalid && !has_warned) say(4, "Invalid offboard setpoint: the vehicle stops and holds");
}

RotorSpeeds Px4::step(const VehicleState& estimate) {
  estimate_ = estimate;
  update_mode();
  if (tick_ % kTicksPerPositionLoop == 0) run_position_loop();
  detect_landing();
  disarm_when_due();
  ++tick_;
  omega_setpoint_body_rad_s_ = attitude_control(
      parameters_, Eigen::Quaterniond(estimate.T_world_body.linear()), attitude_setpoint_);
  return rate_step(estimate.omega_body_rad_s);
}

RotorSpeeds Px4::rate_step(const Vec3& omega_body_rad_s) {
  if (!is_armed_ || nav_state_ == NavState::terminate) return {};
  const Vec3 integral = rate_.integral;
  const RotorCommands commands = rate_loop(parameters_, allocation_, rate_, omega_body_rad_s,
                                           omega_setpoint_body_rad_s_, attitude_setpoint_.thrust);
  if (land_.is_maybe_landed) rate_.integral = integral;  // the ground holds it, not we
  return reference_speeds(airframe_, commands);
}

/// Whether somebody asks the waiting vehicle to fly: offboard, a fresh and valid setpoint that
/// leads upwards.
bool Px4::wants_takeoff() const {
  if (nav_state_ == NavState::takeoff) return true;
  if (nav_state_ != NavState::offboard || offboard_silence_s() >= kTakeoffSetpointAge_s ||
      !is_valid(offboard_setpoint_))
    return false;
  return offboard_setpoint_.p_world_m.z() > estimate_.T_world_body.translation().z() ||
         offboard_setpoint_.v_world_m_s.z() > 0.0 || offboard_setpoint_.a_world_m_s2.z() > 0.0;
}

Setpoint Px4::setpoint_to_fly() {
  if (!is_auto(nav_state_)) return offboard_setpoint_;
  if (takeoff_.phase < TakeoffPhase::ramp) enter(nav_state_);  // the trajectory waits as well
  return step_auto(auto_, parameters_.commander, estimate_, kPositionLoop_s);
}

void Px4::run_position_loop() {
  const CommanderParameters& commander = parameters_.commander;
  takeoff_ =
      next(takeoff_, commander, is_armed_, land_.is_landed, wants_takeoff(), kPositionLoop_s);
  setpoint_ = setpoint_to_fly();

  const bool is_flying = takeoff_.phase == TakeoffPhase::flight;
  const double tilt_aim_rad =
      is_flying ? parameters_.tilt_max_rad : commander.tilt_max_on_ground_rad;
  constexpr double kTiltStep_rad = kTiltLimitSlew_rad_s * kPositionLoop_s;
  tilt_limit_rad_ += std::clamp(tilt_aim_rad - tilt_limit_rad_, -kTiltStep_rad, kTiltStep_rad);

  if (nav_state_ == NavState::terminate) {
    attitude_setpoint_ = idle(estimate_, 0.0);
    return;
  }
  const double thrust_min = is_flying ? parameters_.thrust_min : kRampThrustMin;
  if (takeoff_.phase < TakeoffPhase::ramp || (is_flying && land_.has_ground_contact)) {
    position_.integral_m_s2.setZero();
    attitude_setpoint_ = idle(estimate_, is_flying ? thrust_min : 0.0);
    return;
  }
  const double climb_m_s =
      nav_state_ == NavState::takeoff
          ? std::min(commander.takeoff_speed_m_s, parameters_.climb_speed_max_m_s)
          : parameters_.climb_speed_max_m_s;
  const FlightEnvelope envelope{climb_limit_m_s(takeoff_, airframe_.gravity_m_s2,
                                                parameters_.velocity_p_per_s.z(), climb_m_s),
                                tilt_limit_rad_, thrust_min};
  attitude_setpoint_ =
      position_loop(parameters_, airframe_, envelope, position_, estimate_, setpoint_);
}

void Px4::detect_landing() {
  const LandEvidence evidence{
      .is_armed = is_armed_,
      .is_told_to_descend = asks_for_descent(setpoint_) || nav_state_ == NavState::terminate,
      .thrust = attitude_setpoint_.thrust,
      .thrust_min = parameters_.thrust_min,
      .hover_thrust = hover_command(airframe_)};
  const bool was_landed = land_.is_landed;
  land_ = next(land_, parameters_.commander, evidence, estimate_, kTick_s);
  if (!is_armed_ || was_landed == land_.is_landed) return;
  if (land_.is_landed)
    say(6, "Landing detected");
  else
    say(6, "Takeoff detected");
}

}  // namespace gnbv
