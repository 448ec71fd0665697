// From what was asked for to the scenario that is flown; `run`, `table` and `sweep` resolve alike.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scenarios/load.hpp"
#include "scenarios/scenario.hpp"
#include "tools/mission/auto_bounds.hpp"
#include "tools/mission/user_function.hpp"

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

/// `--views FILE`: the override that has the file's views flown.
Override views_of_file(const std::string& file);

/// Of the scenario's structure; throws BadInput when the structure cannot be had.
StructureExtent structure_extent(const Scenario& scenario);

/// The scenario with the options applied: --mesh, --utility, --preset, --seed, --views, --set, then
/// `overrides`, then --bounds auto, which leaves alone what they gave. `unused_notes` (may be null)
/// gets a sentence for each key that was given and has no effect. `extent` is asked only for
/// bounds_auto: whoever resolves many scenarios of one structure can answer from memory.
Scenario resolve_scenario(
    const ScenarioOptions& options, std::vector<std::string>* unused_notes = nullptr,
    const std::vector<Override>& overrides = {},
    const std::function<StructureExtent(const Scenario&)>& extent = structure_extent);

}  // namespace gnbv
