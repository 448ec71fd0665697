// Which mode runs: PX4's mode requirements and fallbacks (mode_requirements.cpp, failsafe.cpp,
// framework.cpp), as pure functions.
#pragma once

#include "sim/flight/commander_parameters.hpp"
#include "sim/flight/nav_state.hpp"

namespace gnbv {

/// What a mode may need. Here the estimates never fail, and there is neither a remote control nor
/// a mission.
struct Health {
  bool has_attitude = true;
  bool has_altitude = true;
  bool has_position = true;
  bool has_offboard_stream = false;
  bool has_remote_control = false;
  bool has_mission = false;
};

bool can_run(NavState mode, const Health& health);

/// Landing, returning and the emergency modes refuse arming (mode_req_prevent_arming).
bool prevents_arming(NavState mode);

/// The mode, or the first after it that can run in the order position, altitude, stabilized, hold,
/// rtl, land, descend, terminate. A mode outside that order falls back as `hold`.
NavState feasible(NavState mode, const Health& health);

struct ModeChoice {
  NavState mode = NavState::hold;
  bool is_failsafe = false;  // another mode than the intended one
  bool disarms = false;      // OffboardLossAction::disarm
};

/// What an armed vehicle does that was told `intention`, `offboard_silence_s` after the last
/// setpoint of the offboard stream. Follows the intention again as soon as it can run.
ModeChoice choose_mode(NavState intention, const Health& health, double offboard_silence_s,
                       const CommanderParameters& parameters);

}  // namespace gnbv
