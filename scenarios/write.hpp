// A scenario's values as text.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "scenarios/scenario.hpp"

namespace gnbv {

/// Every value with the path of its key ("cameras.0.range_max_m"), as YAML, in the order of the
/// file. "path=text" is an override that load_scenario takes.
std::vector<std::pair<std::string, std::string>> scenario_values(const Scenario& scenario);

}  // namespace gnbv
