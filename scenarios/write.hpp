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

/// One of them, and what the scenario makes of it.
struct ValueUse {
  std::string path;
  std::string text;
  std::string unused_by;           // the key because of whose value it has no effect; else empty
  bool is_papers_setting = false;  // the paper's figures depend on it, and the paper states it
};
std::vector<ValueUse> value_uses(const Scenario& scenario);

}  // namespace gnbv
