// The commanding half of Px4: acknowledgements, arming and the choice of the mode.
#include <cmath>
#include <limits>
#include <string>

#include "sim/flight/px4.hpp"

namespace gnbv {
namespace {

constexpr std::uint16_t kNavReturnToLaunch = 20;
constexpr std::uint16_t kNavLand = 21;
constexpr std::uint16_t kNavTakeoff = 22;
constexpr std::uint16_t kDoSetMode = 176;
constexpr std::uint16_t kComponentArmDisarm = 400;
constexpr long kForce = 21196;

}  // namespace

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
      if (!mode) {
        say(2, "Unsupported mode");
        return Ack::temporarily_rejected;
      }
      return set_mode(*mode);
    }
    case kNavTakeoff: {
      const double altitude_m = command.param[6];
      const Ack ack = set_mode(NavState::takeoff);
      if (ack == Ack::accepted && std::isfinite(altitude_m)) {
        takeoff_altitude_m_ = altitude_m;
        if (nav_state_ == NavState::takeoff) enter(NavState::takeoff);
      }
      return ack;
    }
    case kNavLand:
      return set_mode(NavState::land);
    case kNavReturnToLaunch:
      return set_mode(NavState::rtl);
    default:
      return Ack::unsupported;
  }
}

double Px4::offboard_silence_s() const {
  if (!heartbeat_tick_) return std::numeric_limits<double>::infinity();
  return static_cast<double>(tick_ - *heartbeat_tick_) * kTick_s;
}

bool Px4::can_run_now(NavState mode) const {
  return can_run(mode, has_offboard_stream(offboard_silence_s(), parameters_.commander));
}

Ack Px4::arm(bool armed, bool force) {
  if (armed == is_armed_) return Ack::accepted;
  if (!armed) {
    if (!force && !land_.is_maybe_landed) {
      say(2, "Disarming denied: not landed");
      return Ack::temporarily_rejected;
    }
    disarm();
    return Ack::accepted;
  }
  // force skips no check here: PX4 runs them for any arming from outside
  if (!can_run_now(intention_) || prevents_arming(nav_state_)) {
    say(2, "Arming denied: not in " + std::string(name_of(intention_)));
    return Ack::temporarily_rejected;
  }
  is_armed_ = true;
  has_flown_ = false;
  landed_ticks_ = 0;
  home_world_m_ = estimate_.T_world_body.translation().head<2>();
  position_ = {};
  rate_ = {};
  say(6, "Armed");
  update_mode();
  return Ack::accepted;
}

void Px4::disarm() {
  is_armed_ = false;
  intention_ = intention_after_disarming_;
  say(6, "Disarmed");
  update_mode();
}

void Px4::disarm_when_due() {
  if (!is_armed_) return;
  has_flown_ = has_flown_ || !land_.is_landed;
  landed_ticks_ = land_.is_landed ? landed_ticks_ + 1 : 0;
  const CommanderParameters& commander = parameters_.commander;
  const double wait_s =
      has_flown_ ? commander.disarm_after_landing_s : commander.disarm_never_flown_s;
  if (!land_.is_landed || wait_s <= 0.0) return;
  if (static_cast<double>(landed_ticks_) * kTick_s >= wait_s) disarm();
}

Ack Px4::set_mode(NavState mode) {
  // LAND is always taken: where it cannot run, the fallback descends
  const bool is_allowed = !is_armed_ || mode == NavState::land || can_run_now(mode);
  if (nav_state_ == NavState::terminate || !is_allowed) {
    say(2, "Switching to " + std::string(name_of(mode)) + " is not possible now");
    return Ack::temporarily_rejected;
  }
  intention_ = mode;
  if (!prevents_arming(mode) || mode == NavState::terminate) intention_after_disarming_ = mode;
  if (mode == NavState::takeoff) takeoff_altitude_m_ = parameters_.commander.takeoff_altitude_m;
  update_mode();
  return Ack::accepted;
}

/// The mode that runs follows intention and health.
void Px4::update_mode() {
  if (nav_state_ == NavState::terminate) return;  // never left
  if (nav_state_ == NavState::takeoff && takeoff_.phase == TakeoffPhase::flight &&
      is_finished(auto_, estimate_)) {
    intention_ = intention_after_disarming_ = nav_state_ = NavState::hold;
    auto_ = hold_after_takeoff(auto_);
  }
  ModeChoice choice{intention_, false, false};
  if (is_armed_) {
    choice = choose_mode(intention_, offboard_silence_s(), parameters_.commander);
  }
  if (choice.disarms) {
    say(2, "Failsafe: offboard stream lost, disarming");
    disarm();
    return;
  }
  const bool is_change = choice.mode != nav_state_;
  if (choice.is_failsafe && (is_change || !is_in_failsafe_)) {
    say(4, "Failsafe: " + std::string(name_of(intention_)) + " cannot run, " +
               std::string(name_of(choice.mode)));
  } else if (!choice.is_failsafe && is_in_failsafe_) {
    say(6, "Failsafe over: " + std::string(name_of(intention_)));
  }
  is_in_failsafe_ = choice.is_failsafe;
  if (is_change) enter(choice.mode);
}

/// Between Auto modes the trajectory goes on as it is, except after a descent, which leaves it
/// below the vehicle. OFFBOARD begins with no setpoint, that is, it stops and holds.
void Px4::enter(NavState mode) {
  const bool was_on_trajectory = auto_.mode == nav_state_ &&
                                 auto_.stage < AutoFlight::Stage::land &&
                                 takeoff_.phase >= TakeoffPhase::ramp;
  const std::array<SmoothedAxis, 3> axes = auto_.axes;
  nav_state_ = mode;
  auto_ = begin_auto(mode, parameters_.commander, estimate_, home_world_m_, takeoff_altitude_m_);
  if (was_on_trajectory) auto_.axes = axes;
  offboard_setpoint_ = Setpoint{};
  has_warned_of_setpoint_ = false;
}

}  // namespace gnbv
