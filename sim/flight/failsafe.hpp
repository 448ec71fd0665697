// Which mode runs: PX4's mode requirements and fallbacks (mode_requirements.cpp, failsafe.cpp,
// framework.cpp), as pure functions. Here the estimates never fail, and there is neither a remote
// control nor a mission: what is left to lose is the offboard stream.
#pragma once

#include "sim/flight/commander_parameters.hpp"
#include "sim/flight/nav_state.hpp"

namespace gnbv {

bool can_run(NavState mode, bool has_offboard_stream);

/// Landing, returning and the emergency modes refuse arming (mode_req_prevent_arming).
bool prevents_arming(NavState mode);

struct ModeChoice {
  NavState mode = NavState::hold;
  bool is_failsafe = false;  // another mode than the intended one
  bool disarms = false;      // OffboardLossAction::disarm
};

/// Whether the last setpoint of the offboard stream, `offboard_silence_s` ago, still counts.
bool has_offboard_stream(double offboard_silence_s, const CommanderParameters& parameters);

/// What an armed vehicle does that was told `intention`. Follows the intention again as soon as it
/// can run. A mode that cannot falls back to hold: of PX4's order (position, altitude, stabilized,
/// hold, rtl, land, descend, terminate) those before hold need a remote control.
ModeChoice choose_mode(NavState intention, double offboard_silence_s,
                       const CommanderParameters& parameters);

}  // namespace gnbv
