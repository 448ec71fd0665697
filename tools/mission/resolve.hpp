// From what was asked for to the scenario that is flown; `run`, `table` and `sweep` resolve alike.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scenarios/load.hpp"
#include "scenarios/scenario.hpp"

namespace gnbv {

/// Which scenario is meant.
struct ScenarioOptions {
  std::string scenario;                // built-in name or YAML path
  std::string mesh;                    // overrides the scenario's structure; "" keeps it
  std::string utility;                 // "" keeps the scenario's
  std::string preset;                  // "" keeps the scenario's
  std::string seed;                    // "" keeps the scenario's
  std::vector<std::string> overrides;  // --set key=value, in order
  bool bounds_auto = false;            // lay the workspace and the start around the structure
};

/// The box of the scenario's structure; throws BadInput when the structure cannot be had.
Box3 structure_bounds_m(const Scenario& scenario);

/// The scenario with the options applied: --mesh, --utility, --preset, --seed, then --set.
Scenario resolve_scenario(const ScenarioOptions& options);

/// The same for overrides that say where they come from; they are applied after those of the
/// options. `bounds_m` is asked only for bounds_auto: whoever resolves many scenarios of one
/// structure can answer from memory.
Scenario resolve_scenario(
    const ScenarioOptions& options, const std::vector<Override>& overrides,
    const std::function<Box3(const Scenario&)>& bounds_m = structure_bounds_m);

}  // namespace gnbv
