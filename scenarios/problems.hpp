// What is wrong with a scenario whose values are each allowed, but do not go together.
#pragma once

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "scenarios/scenario.hpp"

namespace gnbv {

struct Problem {
  std::vector<std::string> keys;  // whose values do not go together, the likeliest cause first
  std::string what;
};
using Problems = std::vector<Problem>;

/// All of them; none for a scenario that can be run.
Problems problems(const Scenario& scenario);

/// What to say of a scenario whose cameras clear through surface: where pixels without a return
/// mean free space (planner.map.no_return), and returns end before that does. "" for any other.
std::string clearing_note(const Scenario& scenario);

/// Its parts: add what is wrong with vehicle, guidance and wind, and with cameras and LIDARs.
void check_vehicle(const Scenario& scenario, Problems& out);
void check_sensors(const Scenario& scenario, Problems& out);

/// Returns whether the condition holds; adds a problem where it does not. `what` is a fmt message.
template <typename... Args>
bool require(bool holds, Problems& out, std::vector<std::string> keys,
             fmt::format_string<Args...> what, Args&&... args) {
  if (!holds) out.push_back({std::move(keys), fmt::format(what, std::forward<Args>(args)...)});
  return holds;
}
/// Two keys of one section whose values have to be in order; `section` ends with a dot.
inline void require_below(Problems& out, const std::string& section, const char* low_key,
                          double low, const char* high_key, double high) {
  require(low < high, out, {section + high_key, section + low_key},
          "{0}{1} = {2} has to be below {0}{3} = {4}", section, low_key, low, high_key, high);
}

}  // namespace gnbv
