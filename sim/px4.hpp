// PX4 as an external client meets it: commands with acknowledgements, modes, arming, the offboard
// stream and its failsafe, takeoff ramp, landing detection. Simulation time only, no input or
// output: the same calls at the same ticks give the same flight, bit by bit. Source of every rule:
// PX4-Autopilot, as listed in the tests (Commander.cpp, UserModeIntention.cpp, offboardCheck.cpp,
// failsafe.cpp, Takeoff.cpp, MulticopterLandDetector.cpp).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/autopilot.hpp"

namespace gnbv {

/// PX4's navigation states. There is no remote control here, so the modes that need one (manual to
/// position) can be asked for, but cannot run: Commander falls back from them.
enum class NavState {
  manual,
  stabilized,
  altitude,
  position,
  hold,  // AUTO_LOITER
  mission,
  rtl,
  takeoff,
  land,
  descend,
  offboard,
  terminate
};
std::string_view name_of(NavState state);

/// MAV_RESULT.
enum class Ack : std::uint8_t {
  accepted = 0,
  temporarily_rejected = 1,
  denied = 2,
  unsupported = 3
};

/// A MAV_CMD with its seven parameters, as COMMAND_LONG carries them. Known: 400
/// COMPONENT_ARM_DISARM (21196 in param2 forces), 176 DO_SET_MODE (param2 main mode, param3 sub
/// mode, PX4's custom modes), 22 NAV_TAKEOFF (param7: altitude above the ground in metres, NaN for
/// the default), 21 NAV_LAND, 20 NAV_RETURN_TO_LAUNCH.
struct Px4Command {
  std::uint16_t id = 0;
  std::array<float, 7> param{};
};

/// MAV_SEVERITY: 0 emergency ... 4 warning, 6 info.
struct StatusText {
  int severity = 6;
  std::string text;
};

class Px4 {
 public:
  enum class Start {
    on_ground,         // disarmed, in HOLD
    airborne_offboard  // armed, flying, in OFFBOARD with a stream just received: a mission begins
                       // here
  };
  Px4(const AutopilotParameters& parameters, const AirframeParameters& airframe,
      const VehicleState& start, Start how);

  Ack command(const Px4Command& command);
  Ack arm(bool armed, bool force = false);
  Ack set_mode(NavState mode);
  /// A setpoint of the offboard stream (world ENU). A valid one refreshes the heartbeat in any
  /// mode; it is flown only in OFFBOARD. An invalid one (Setpoint) stops and holds, with a warning.
  void offboard_setpoint(const Setpoint& setpoint);

  /// Advances one tick: rotor references, 0 when disarmed.
  RotorSpeeds step(const VehicleState& estimate);

  std::int64_t tick() const;
  NavState nav_state() const;  // what runs
  NavState intention() const;  // what was asked for
  bool is_armed() const;
  bool is_landed() const;
  bool is_in_failsafe() const;
  /// What was said since the last call, oldest first.
  std::vector<StatusText> take_messages();
};

}  // namespace gnbv
