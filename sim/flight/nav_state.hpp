// PX4's flight modes by name.
#pragma once

#include <string_view>

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

}  // namespace gnbv
