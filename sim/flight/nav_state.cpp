#include "sim/flight/nav_state.hpp"

#include <array>

namespace gnbv {

std::string_view name_of(NavState state) {
  constexpr std::array<std::string_view, 12> kNames = {
      "MANUAL", "STABILIZED", "ALTITUDE", "POSITION", "HOLD",     "MISSION",
      "RTL",    "TAKEOFF",    "LAND",     "DESCEND",  "OFFBOARD", "TERMINATE"};
  return kNames.at(static_cast<std::size_t>(state));
}

}  // namespace gnbv
