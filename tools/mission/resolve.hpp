// From what was asked for to the scenario that is flown; `run`, `table` and `sweep` resolve alike.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scenarios/load.hpp"
#include "scenarios/scenario.hpp"
#include "tools/mission/auto_bounds.hpp"

namespace gnbv {

/// Which scenario is meant.
struct ScenarioOptions {
  std::string scenario;                // built-in name or YAML path
  std::string mesh;                    // overrides the scenario's structure; "" keeps it
  std::string utility;                 // "" keeps the scenario's
  std::string preset;                  // "" keeps the scenario's
  std::string seed;                    // "" keeps the scenario's
  std::vector<std::string> overrides;  // --set key=value, in order
  std::string views;                   // a file of body poses to fly; "" keeps the scenario's
  bool bounds_auto = false;            // lay the workspace and the start around the structure
};

/// Of the scenario's structure; throws BadInput when the structure cannot be had.
StructureExtent structure_extent(const Scenario& scenario);

/// The scenario with the options applied: --mesh, --utility, --preset, --seed, --views, then --set,
/// then
/// --bounds auto, which leaves alone what --set gave.
Scenario resolve_scenario(const ScenarioOptions& options);
/// The same; `unused_notes` gets a sentence for each key that was given and has no effect.
Scenario resolve_scenario(const ScenarioOptions& options, std::vector<std::string>& unused_notes);

/// The same for overrides that say where they come from; they are applied after those of the
/// options. `extent` is asked only for bounds_auto: whoever resolves many scenarios of one
/// structure can answer from memory.
Scenario resolve_scenario(
    const ScenarioOptions& options, const std::vector<Override>& overrides,
    const std::function<StructureExtent(const Scenario&)>& extent = structure_extent,
    std::vector<std::string>* unused_notes = nullptr);

}  // namespace gnbv
