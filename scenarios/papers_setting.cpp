#include "scenarios/papers_setting.hpp"

#include <algorithm>

#include "scenarios/load.hpp"
#include "scenarios/write.hpp"

namespace gnbv {
namespace {

/// What the paper's figures depend on and the paper states, or does not have.
std::vector<std::pair<std::string, std::string>> stated_values(const Scenario& scenario) {
  std::vector<std::pair<std::string, std::string>> stated;
  for (const ValueUse& value : value_uses(scenario)) {
    if (value.is_papers_setting) stated.emplace_back(value.path, value.text);
  }
  return stated;
}

}  // namespace

bool has_papers_setting(const Scenario& scenario) {
  const std::vector<std::string> names = builtin_scenario_names();
  if (std::find(names.begin(), names.end(), scenario.name) == names.end()) return false;
  return stated_values(scenario) == stated_values(load_scenario(scenario.name, {}));
}

}  // namespace gnbv
