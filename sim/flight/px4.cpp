#include "sim/flight/px4.hpp"

#include <algorithm>
#include <cmath>

#include "sim/core/error.hpp"
#include "sim/flight/rotors.hpp"

namespace gnbv {
namespace {

enum MavCommand : std::uint16_t {
  kNavReturnToLaunch = 20,
  kNavLand = 21,
  kNavTakeoff = 22,
  kDoSetMode = 176,
  kDoChangeSpeed = 178,
  kDoSetMissionCurrent = 224,
  kMissionStart = 300,
  kComponentArmDisarm = 400
};
constexpr long kForce = 21196;

constexpr double kTakeoffSetpointAge_s = 1.0;  // older setpoints start no takeoff
constexpr double kTiltLimitSlew_rad_s = 0.2;   // MulticopterPositionControl.hpp
constexpr double kDescentSpeed_m_s = 0.3;      // MulticopterLandDetector.cpp: told to descend
// on the ramp MPC_THR_MIN does not bind yet; not zero, so that the thrust keeps a direction
constexpr double kRampThrustMin = 1e-3;

bool is_auto(NavState mode) {
  return mode == NavState::hold || mode == NavState::takeoff || mode == NavState::land ||
         mode == NavState::rtl || mode == NavState::mission;
}

std::string text_of(NavState mode) { return std::string(name_of(mode)); }

}  // namespace

Px4::Px4(const AutopilotParameters& parameters, const AirframeParameters& airframe,
         const VehicleState& start, Start how)
    : parameters_(parameters),
      airframe_(airframe),
      allocation_(allocation_of(airframe)),
      estimate_(start),
      home_world_m_(start.T_world_body.translation()),
      tilt_limit_rad_(parameters.commander.tilt_max_on_ground_rad) {
  hover_command(airframe);  // throws for a vehicle that cannot hover
  if (how == Start::on_ground) {
    set_home();
    return;
  }
  home_world_m_.z() = 0.0;  // the ground below is not known
  intention_ = intention_after_disarming_ = nav_state_ = NavState::offboard;
  is_armed_ = has_flown_ = true;
  takeoff_.phase = TakeoffPhase::flight;
  land_ = LandDetector{};
  tilt_limit_rad_ = parameters.tilt_max_rad;
  offboard_setpoint_.p_world_m = start.T_world_body.translation();
  offboard_setpoint_.yaw_rad = yaw_of(start.T_world_body);
  heartbeat_tick_ = 0;
}

void Px4::say(int severity, std::string text) { messages_.push_back({severity, std::move(text)}); }

Ack Px4::reject(std::string text) {
  say(kSeverityCritical, std::move(text));
  return Ack::temporarily_rejected;
}

Ack Px4::command(const Px4Command& command) {
  const auto whole = [&](std::size_t i) {
    return std::isfinite(command.param[i]) ? std::lround(command.param[i]) : -1;
  };
  switch (command.id) {
    case kComponentArmDisarm:
      if (whole(0) != 0 && whole(0) != 1) return Ack::unsupported;
      return arm(whole(0) == 1, whole(1) == kForce);
    case kDoSetMode: {
      const std::optional<NavState> mode = nav_state_of(whole(1), whole(2));
      return mode ? set_mode(*mode) : reject("Unsupported mode");
    }
    case kNavTakeoff: {
      const double altitude_m = command.param[6];
      const Ack ack = set_mode(NavState::takeoff);
      if (ack == Ack::accepted && std::isfinite(altitude_m)) {
        takeoff_altitude_m_ = altitude_m - home_world_m_.z();
        if (nav_state_ == NavState::takeoff) enter(NavState::takeoff);
      }
      return ack;
    }
    case kNavLand:
      return set_mode(NavState::land);
    case kNavReturnToLaunch:
      return set_mode(NavState::rtl);
    case kDoChangeSpeed:
      return change_speed(command.param[0], command.param[1]);
    case kDoSetMissionCurrent:
      return whole(0) >= 0 && set_current_step(static_cast<std::size_t>(whole(0))) ? Ack::accepted
                                                                                   : Ack::denied;
    case kMissionStart:
      return start_mission(command.param[0]);
    default:
      return Ack::unsupported;
  }
}

/// Of the ways of changing speed that PX4 has only that over ground (by air is the same here).
Ack Px4::change_speed(double kind, double speed_m_s) {
  if (kind != 0.0 && kind != 1.0) return Ack::unsupported;
  const bool is_default = speed_m_s == -2.0;
  if (!is_default && speed_m_s != -1.0 &&
      !(speed_m_s > 0.0 && speed_m_s <= parameters_.speed_max_m_s))
    return Ack::denied;
  if (speed_m_s != -1.0) auto_.speed_m_s = is_default ? 0.0 : speed_m_s;
  return Ack::accepted;
}

Ack Px4::start_mission(double first_step) {
  const double count = static_cast<double>(mission_.steps.size());
  if (!(first_step >= -1.0 && first_step < count) || count == 0.0) return Ack::denied;
  if (first_step >= 0.0) set_current_step(static_cast<std::size_t>(first_step));
  const Ack ack = set_mode(NavState::mission);
  return ack == Ack::accepted ? arm(true) : ack;
}

Ack Px4::reposition(const Vec3& goal_world_m, double yaw_rad, double speed_m_s) {
  if (!is_armed_ || land_.is_landed) return reject("Reposition is not possible on the ground");
  const Ack ack = set_mode(NavState::hold);
  if (ack != Ack::accepted) return ack;
  if (speed_m_s > 0.0) auto_.speed_m_s = std::min(speed_m_s, parameters_.speed_max_m_s);
  const Vec3 p_world_m = estimate_.T_world_body.translation();
  go_to(auto_, goal_world_m.array().isNaN().select(p_world_m, goal_world_m), yaw_rad);
  return ack;
}

void Px4::set_mission(std::vector<MissionStep> steps) {
  const bool is_cleared = steps.empty();
  mission_ = UploadedMission{.steps = std::move(steps)};
  if (is_cleared && intention_ == NavState::mission) {
    intention_ = intention_after_disarming_ = NavState::hold;
  }
}

bool Px4::set_current_step(std::size_t step) {
  if (step >= mission_.steps.size()) return false;
  mission_.current = step;
  mission_.phase = UploadedMission::Phase::begins;
  mission_.is_complete = false;
  return true;
}

bool Px4::is_taking_off() const {
  if (land_.is_landed) return false;
  return nav_state_ == NavState::takeoff ||
         (nav_state_ == NavState::mission && mission_.phase == UploadedMission::Phase::climbs);
}

bool Px4::is_landing() const {
  return !land_.is_landed && is_auto(nav_state_) && auto_.stage == AutoFlight::Stage::land;
}

Ack Px4::arm(bool armed, bool force) {
  if (armed == is_armed_) return Ack::accepted;
  if (!armed) {
    if (!force && !land_.is_maybe_landed) return reject("Disarming denied: not landed");
    disarm();
    return Ack::accepted;
  }
  // force skips no check here: PX4 runs them for any arming from outside
  if (!can_run_now(intention_) || prevents_arming(nav_state_)) {
    return reject("Arming denied: not in " + text_of(intention_));
  }
  is_armed_ = true;
  has_flown_ = false;
  landed_ticks_ = 0;
  set_home();
  position_ = {};
  rate_ = {};
  say(kSeverityInfo, "Armed");
  update_mode();
  return Ack::accepted;
}

void Px4::set_home() {
  const Vec3 p_world_m = estimate_.T_world_body.translation();
  home_world_m_ = p_world_m - 0.5 * airframe_.hull_height_m * Vec3::UnitZ();
}

Ack Px4::set_mode(NavState mode) {
  // LAND is always taken
  const bool is_allowed = !is_armed_ || mode == NavState::land || can_run_now(mode);
  if (nav_state_ == NavState::terminate || !is_allowed) {
    return reject("Switching to " + text_of(mode) + " is not possible now");
  }
  intention_ = mode;
  if (!prevents_arming(mode) || mode == NavState::terminate) intention_after_disarming_ = mode;
  if (mode == NavState::takeoff) takeoff_altitude_m_ = parameters_.commander.takeoff_altitude_m;
  update_mode();
  return Ack::accepted;
}

void Px4::offboard_setpoint(const Setpoint& setpoint) {
  const bool is_invalid = !is_valid(setpoint);
  if (!is_invalid) heartbeat_tick_ = tick_;
  if (nav_state_ != NavState::offboard) return;
  offboard_setpoint_ = setpoint;
  const bool has_warned = std::exchange(has_warned_of_setpoint_, is_invalid);
  if (is_invalid && !has_warned) {
    say(kSeverityWarning, "Invalid offboard setpoint: the vehicle stops and holds");
  }
}

double Px4::offboard_silence_s() const {
  if (!heartbeat_tick_) return std::numeric_limits<double>::infinity();
  return static_cast<double>(tick_ - *heartbeat_tick_) * kTick_s;
}

bool Px4::can_run_now(NavState mode) const {
  if (mode == NavState::mission) return !mission_.steps.empty();
  return can_run(mode, offboard_silence_s(), parameters_.commander);
}

void Px4::disarm() {
  is_armed_ = false;
  if (land_.is_landed) set_home();  // a takeoff may be asked for before the next arming
  intention_ = intention_after_disarming_;
  say(kSeverityInfo, "Disarmed");
  update_mode();
}

/// The mode that runs follows intention and health.
void Px4::update_mode() {
  if (nav_state_ == NavState::terminate) return;  // never left
  if (takeoff_.phase == TakeoffPhase::flight && nav_state_ == NavState::takeoff &&
      is_finished(auto_, estimate_)) {  // HOLD ends what is left of the way
    intention_ = intention_after_disarming_ = nav_state_ = auto_.mode = NavState::hold;
  }
  std::optional<NavState> mode = intention_;
  if (is_armed_ && !can_run_now(intention_)) {
    mode = choose_mode(intention_, offboard_silence_s(), parameters_.commander);
  }
  if (!mode) {
    say(kSeverityCritical, "Failsafe: offboard stream lost, disarming");
    disarm();
    return;
  }
  const bool is_failsafe = *mode != intention_;
  if (is_failsafe && (*mode != nav_state_ || !is_in_failsafe_)) {
    say(kSeverityWarning, "Failsafe: " + text_of(intention_) + " cannot run, " + text_of(*mode));
  } else if (!is_failsafe && is_in_failsafe_) {
    say(kSeverityInfo, "Failsafe over: " + text_of(intention_));
  }
  is_in_failsafe_ = is_failsafe;
  if (*mode != nav_state_) enter(*mode);
}

/// Between Auto modes the trajectory goes on as it is, except that of a landing, which is below the
/// vehicle. OFFBOARD begins with no setpoint, that is, it stops and holds.
void Px4::enter(NavState mode) {
  const bool was_on_trajectory = is_auto(nav_state_) && auto_.stage < AutoFlight::Stage::land &&
                                 takeoff_.phase >= TakeoffPhase::ramp;
  const std::array<Motion, 3> axes = auto_.axes;
  const double speed_m_s = is_armed_ ? auto_.speed_m_s : 0.0;
  // a mission that has just landed ends its landing before it begins anew
  const bool lands = nav_state_ == mode && mission_.phase == UploadedMission::Phase::lands;
  if (!lands) mission_.phase = UploadedMission::Phase::begins;
  nav_state_ = mode;
  auto_ = begin_auto(mode, parameters_.commander, estimate_, home_world_m_, takeoff_altitude_m_);
  if (was_on_trajectory) auto_.axes = axes;
  auto_.speed_m_s = speed_m_s;
  offboard_setpoint_ = Setpoint{};
  has_warned_of_setpoint_ = false;
}

RotorSpeeds Px4::step(const VehicleState& estimate) {
  estimate_ = estimate;
  update_mode();
  if (tick_ % kTicksPerPositionLoop == 0) run_position_loop();
  follow_landing();
  ++tick_;
  omega_setpoint_body_rad_s_ = attitude_control(
      parameters_, Eigen::Quaterniond(estimate.T_world_body.linear()), attitude_setpoint_);
  return rate_step(estimate.omega_body_rad_s);
}

RotorSpeeds Px4::rate_step(const Vec3& omega_body_rad_s) {
  if (!is_armed_ || nav_state_ == NavState::terminate) return {};
  const Vec3 integral = rate_.integral;
  const RotorCommands commands =
      rate_control(parameters_, allocation_, rate_, omega_body_rad_s, omega_setpoint_body_rad_s_,
                   attitude_setpoint_.thrust);
  if (land_.is_maybe_landed) rate_.integral = integral;  // the ground holds it, not we
  return reference_speeds(airframe_, commands);
}

/// Whether somebody asks the waiting vehicle to fly: offboard, a fresh and valid setpoint that
/// leads upwards.
bool Px4::wants_takeoff() const {
  if (nav_state_ == NavState::takeoff || nav_state_ == NavState::mission) return true;
  if (nav_state_ != NavState::offboard || offboard_silence_s() >= kTakeoffSetpointAge_s ||
      !is_valid(offboard_setpoint_))
    return false;
  return offboard_setpoint_.p_world_m.z() > estimate_.T_world_body.translation().z() ||
         offboard_setpoint_.v_world_m_s.z() > 0.0 || offboard_setpoint_.a_world_m_s2.z() > 0.0;
}

/// By the mission; what comes after it is another mode's.
void Px4::lead() {
  switch (step_mission(mission_, auto_, parameters_.commander, estimate_, land_.is_landed,
                       kPositionLoop_s)) {
    case MissionEvent::none:
      return;
    case MissionEvent::returns_home:
      set_mode(NavState::rtl);
      return;
    case MissionEvent::over:
      say(kSeverityInfo, "Mission finished");
      const AutoFlight last = auto_;
      set_mode(NavState::hold);
      if (last.stage == AutoFlight::Stage::go_to) {
        go_to(auto_, last.goal_world_m, last.goal_yaw_rad);
      }
  }
}

void Px4::run_position_loop() {
  const CommanderParameters& commander = parameters_.commander;
  takeoff_ =
      next(takeoff_, commander, is_armed_, land_.is_landed, wants_takeoff(), kPositionLoop_s);
  setpoint_ = offboard_setpoint_;
  if (is_auto(nav_state_)) {
    if (takeoff_.phase < TakeoffPhase::ramp) enter(nav_state_);  // the trajectory waits as well
    const bool lands = mission_.phase == UploadedMission::Phase::lands;
    if (nav_state_ == NavState::mission && (is_armed_ || lands)) lead();
    setpoint_ = step_auto(auto_, commander, estimate_, kPositionLoop_s);
  }

  const bool is_flying = takeoff_.phase == TakeoffPhase::flight;
  const double tilt_aim_rad =
      is_flying ? parameters_.tilt_max_rad : commander.tilt_max_on_ground_rad;
  constexpr double kTiltStep_rad = kTiltLimitSlew_rad_s * kPositionLoop_s;
  tilt_limit_rad_ += std::clamp(tilt_aim_rad - tilt_limit_rad_, -kTiltStep_rad, kTiltStep_rad);

  const bool is_terminated = nav_state_ == NavState::terminate;
  if (is_terminated || takeoff_.phase < TakeoffPhase::ramp ||
      (is_flying && land_.has_ground_contact)) {  // level at the present heading
    position_.integral_m_s2.setZero();
    const Eigen::AngleAxisd heading(yaw_of(estimate_.T_world_body), Vec3::UnitZ());
    const double thrust = is_flying && !is_terminated ? parameters_.thrust_min : 0.0;
    attitude_setpoint_ = {Eigen::Quaterniond(heading), thrust, 0.0};
    return;
  }
  const double climb_m_s =
      nav_state_ == NavState::takeoff
          ? std::min(commander.takeoff_speed_m_s, parameters_.climb_speed_max_m_s)
          : parameters_.climb_speed_max_m_s;
  AutopilotParameters narrowed = parameters_;
  narrowed.climb_speed_max_m_s = climb_limit_m_s(takeoff_, airframe_.gravity_m_s2,
                                                 parameters_.velocity_p_per_s.z(), climb_m_s);
  narrowed.descent_speed_max_m_s =  // a climb limit below zero asks for that descent at least
      std::max(parameters_.descent_speed_max_m_s, -narrowed.climb_speed_max_m_s);
  narrowed.tilt_max_rad = tilt_limit_rad_;
  if (!is_flying) narrowed.thrust_min = kRampThrustMin;
  attitude_setpoint_ = position_control(narrowed, airframe_, position_, estimate_, setpoint_);
}

/// Detects takeoff and landing, and disarms when it is due.
void Px4::follow_landing() {
  const CommanderParameters& commander = parameters_.commander;
  const LandEvidence evidence{
      .is_armed = is_armed_,
      .is_told_to_descend = setpoint_.v_world_m_s.z() < -kDescentSpeed_m_s ||  // NaN: no
                            nav_state_ == NavState::terminate,
      .thrust = attitude_setpoint_.thrust,
      .thrust_min = parameters_.thrust_min,
      .hover_thrust = hover_command(airframe_)};
  const bool was_landed = land_.is_landed;
  land_ = next(land_, commander, evidence, estimate_, kTick_s);
  if (!is_armed_) return;
  if (was_landed != land_.is_landed) {
    say(kSeverityInfo, land_.is_landed ? "Landing detected" : "Takeoff detected");
  }
  has_flown_ = has_flown_ || !land_.is_landed;
  landed_ticks_ = land_.is_landed ? landed_ticks_ + 1 : 0;
  const double wait_s =
      has_flown_ ? commander.disarm_after_landing_s : commander.disarm_never_flown_s;
  if (!land_.is_landed || wait_s <= 0.0) return;
  if (static_cast<double>(landed_ticks_) * kTick_s >= wait_s) disarm();
}

}  // namespace gnbv
