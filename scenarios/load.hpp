// Scenario files: YAML in, typed values out, nothing guessed.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scenarios/scenario.hpp"

namespace gnbv {

/// Built-in scenario names, sorted.
std::vector<std::string> builtin_scenario_names();

/// Reads a built-in name or a YAML path, then applies `overrides` ("planner.utility.name=isler", in
/// order; the value is YAML). Throws BadInput listing every fault: unknown key (with the nearest
/// known one), wrong type, value out of range, each with file, line, key and value.
Scenario load_scenario(const std::string& name_or_path, const std::vector<std::string>& overrides);

/// The resolved configuration as YAML: load_scenario on it gives the same Scenario.
std::string to_yaml(const Scenario& scenario);

/// JSON schema of the scenario file, for editors.
std::string scenario_json_schema();

}  // namespace gnbv
