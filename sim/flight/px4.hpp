// PX4 as an external client meets it: commands with acknowledgements, modes, arming, the offboard
// stream and its failsafe, takeoff ramp, landing detection. The same calls at the same ticks give
// the same flight, bit by bit. Source of every rule: PX4-Autopilot, as listed in the tests
// (Commander.cpp, UserModeIntention.cpp, offboardCheck.cpp, and those of commander.hpp).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/flight/cascade.hpp"
#include "sim/flight/commander.hpp"
#include "sim/flight/mission.hpp"

namespace gnbv {

/// MAV_RESULT, from 0 on.
enum class Ack : std::uint8_t { accepted, temporarily_rejected, denied, unsupported };

/// A MAV_CMD with its seven parameters, as COMMAND_LONG carries them. Known: 400
/// COMPONENT_ARM_DISARM (21196 in param2 forces), 176 DO_SET_MODE (param2 main mode, param3 sub
/// mode, PX4's custom modes), 22 NAV_TAKEOFF (param7: altitude in metres above the sea, world
/// z = 0, NaN for MIS_TAKEOFF_ALT above home), 21 NAV_LAND, 20 NAV_RETURN_TO_LAUNCH, 178
/// DO_CHANGE_SPEED (param1 0 to 3, param2 m/s, -1 as it is, -2 the default), 300 MISSION_START
/// (param1: the first step; arms as well), 224 DO_SET_MISSION_CURRENT.
struct Px4Command {
  std::uint16_t id = 0;
  std::array<float, 7> param{};
};

/// MAV_SEVERITY.
constexpr int kSeverityCritical = 2;
constexpr int kSeverityWarning = 4;
constexpr int kSeverityInfo = 6;
struct StatusText {
  int severity = kSeverityInfo;
  std::string text;
};

class Px4 {
 public:
  enum class Start {
    on_ground,         // disarmed, in HOLD
    airborne_offboard  // a mission's: armed, flying, in OFFBOARD with a stream just received
  };
  /// Throws BrokenInvariant when the airframe cannot hover.
  Px4(const AutopilotParameters& parameters, const AirframeParameters& airframe,
      const VehicleState& start, Start how);

  /// As if the vehicle had hovered for long against what takes this acceleration: the velocity
  /// integral begins there.
  void trim(const Vec3& a_world_m_s2) { position_.integral_m_s2 = a_world_m_s2; }

  Ack command(const Px4Command& command);
  Ack arm(bool armed, bool force = false);
  Ack set_mode(NavState mode);
  /// Flies there in HOLD and stays; NaN: the axis, or the heading towards the place, as it is.
  Ack reposition(const Vec3& goal_world_m, double yaw_rad, double speed_m_s);
  /// In place of the one before, from its first step on; none clears it.
  void set_mission(std::vector<MissionStep> steps);
  /// False for a step that there is not.
  bool set_current_step(std::size_t step);
  /// A setpoint of the offboard stream (world ENU). A valid one refreshes the heartbeat in any
  /// mode, but only those that come in OFFBOARD are flown: until the first of them the vehicle
  /// stops and holds. An invalid one (Setpoint) does so too, with a warning.
  void offboard_setpoint(const Setpoint& setpoint);

  /// Advances one tick: rotor references, 0 when disarmed.
  RotorSpeeds step(const VehicleState& estimate);
  /// The rate loop alone, for the other kRateStepsPerTick - 1 steps within the tick.
  RotorSpeeds rate_step(const Vec3& omega_body_rad_s);

  std::int64_t tick() const { return tick_; }
  NavState nav_state() const { return nav_state_; }  // what runs
  NavState intention() const { return intention_; }  // what was asked for
  bool is_armed() const { return is_armed_; }
  bool is_landed() const { return land_.is_landed; }
  bool is_taking_off() const;  // in the air; so is the next
  bool is_landing() const;
  bool is_in_failsafe() const { return is_in_failsafe_; }
  /// The ground where it stands or, once armed, stood then. What is above home is above this; of a
  /// vehicle that began in the air, above z = 0.
  const Vec3& home_world_m() const { return home_world_m_; }
  const UploadedMission& mission() const { return mission_; }
  /// Steps done since the last call.
  std::vector<std::uint16_t> take_reached() { return std::exchange(mission_.reached, {}); }
  const CommanderParameters& commander() const { return parameters_.commander; }
  /// From now on, as PX4 takes a changed parameter. A mode that runs keeps what it began with.
  void set_commander(const CommanderParameters& commander) { parameters_.commander = commander; }
  /// What the position loop asks of the attitude loop.
  const AttitudeSetpoint& attitude_setpoint() const { return attitude_setpoint_; }
  /// What was said since the last call, oldest first.
  std::vector<StatusText> take_messages() { return std::exchange(messages_, {}); }

 private:
  double offboard_silence_s() const;
  bool can_run_now(NavState mode) const;
  Ack change_speed(double kind, double speed_m_s);
  Ack start_mission(double first_step);
  void lead();
  void say(int severity, std::string text);
  Ack reject(std::string text);
  void set_home();
  void disarm();
  void update_mode();
  void enter(NavState mode);
  bool wants_takeoff() const;
  void run_position_loop();
  void follow_landing();

  AutopilotParameters parameters_;
  AirframeParameters airframe_;
  Allocation allocation_;
  std::int64_t tick_ = 0;
  VehicleState estimate_;

  NavState intention_ = NavState::hold;
  NavState intention_after_disarming_ = NavState::hold;
  NavState nav_state_ = NavState::hold;
  bool is_in_failsafe_ = false;
  bool is_armed_ = false;
  bool has_flown_ = false;  // since arming
  std::int64_t landed_ticks_ = 0;
  Vec3 home_world_m_;

  Setpoint offboard_setpoint_;
  bool has_warned_of_setpoint_ = false;  // the last one was invalid
  std::optional<std::int64_t> heartbeat_tick_;

  double takeoff_altitude_m_ = 0.0;  // above home
  AutoFlight auto_;
  UploadedMission mission_;
  Takeoff takeoff_;
  LandDetector land_ = kOnGround;
  Setpoint setpoint_;  // what is flown now
  double tilt_limit_rad_ = 0.0;
  PositionControlMemory position_;
  AttitudeSetpoint attitude_setpoint_;
  Vec3 omega_setpoint_body_rad_s_ = Vec3::Zero();
  RateControlMemory rate_;
  std::vector<StatusText> messages_;
};

}  // namespace gnbv
