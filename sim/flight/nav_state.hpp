// PX4's flight modes by name.
#pragma once

#include <cstdint>
#include <optional>
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

/// PX4's custom mode (px4_custom_mode.h): main mode << 16 | sub mode << 24.
std::uint32_t custom_mode_of(NavState state);
/// The reverse, for the modes that can be asked for; sub modes are those of the Auto modes.
std::optional<NavState> nav_state_of(long main_mode, long sub_mode);

}  // namespace gnbv
