#include "sim/flight/nav_state.hpp"

#include <array>

namespace gnbv {
namespace {

struct Mode {
  NavState state;
  std::string_view name;
  std::uint32_t main;
  std::uint32_t sub = 0;  // of the Auto modes, whose main mode is 4
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
    {NavState::descend, "DESCEND", kAuto, 6},
    {NavState::offboard, "OFFBOARD", 6},
    {NavState::terminate, "TERMINATE", 10},
});

const Mode& mode_of(NavState state) { return kModes.at(static_cast<std::size_t>(state)); }

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

}  // namespace gnbv
