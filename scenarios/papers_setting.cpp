#include "scenarios/papers_setting.hpp"

#include <algorithm>
#include <array>

#include "scenarios/faults.hpp"
#include "scenarios/load.hpp"
#include "scenarios/write.hpp"

namespace gnbv {
namespace {

using Values = std::vector<std::pair<std::string, std::string>>;

/// What the paper's figures depend on and the paper states, or does not have.
Values stated_values(const Scenario& scenario) {
  constexpr std::array<std::string_view, 18> kStated = {
      "cameras",
      "lidars",
      "workspace_m",
      "terrain",
      "obstacles",
      "no_fly",
      "score.region_m",
      "wind",
      "vehicle.estimate.outages",
      "vehicle.power.return_home",
      "planner.map.resolution_m",
      "planner.profiling.method",
      "planner.termination.max_iterations",
      "planner.termination.max_distance_m",
      "planner.termination.max_flight_time_s",
      "planner.termination.min_new_voxels_per_m",
      "planner.termination.max_views_without_new_points",
      "benchmark"};
  Values values = scenario_values(scenario);
  std::erase_if(values, [&](const auto& value) {
    return std::none_of(kStated.begin(), kStated.end(), [&](std::string_view stated) {
      return is_at_or_below(value.first, stated);
    });
  });
  return values;
}

}  // namespace

bool has_papers_setting(const Scenario& scenario) {
  const std::vector<std::string> names = builtin_scenario_names();
  if (std::find(names.begin(), names.end(), scenario.name) == names.end()) return false;
  return stated_values(scenario) == stated_values(load_scenario(scenario.name, {}));
}

}  // namespace gnbv
