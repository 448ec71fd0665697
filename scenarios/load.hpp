// Scenario files: YAML in, typed values out, nothing guessed; and typed values back as text.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scenarios/scenario.hpp"

namespace gnbv {

/// Built-in scenario names, sorted.
std::vector<std::string> builtin_scenario_names();

/// Reads a built-in name or a YAML path (a file named like a built-in scenario: "./aircraft"), then
/// applies the overrides in order: "planner.utility.name=isler", "cameras.0.range_max_m=6",
/// "workspace_m={max: [9, 9, 9]}". The value is YAML; a map sets the keys it names, a list replaces
/// the list. Relative paths of a file begin at that file, those of an override at the current
/// folder; in the Scenario they are absolute.
/// Throws BadInput with every error, one a line, `file:line: key: value 'X': what (did you mean)`:
/// syntax, unknown and repeated keys, wrong types, values out of range, problems().
Scenario load_scenario(const std::string& name_or_path, const std::vector<std::string>& overrides);

/// load_scenario() of a configuration that was flown: its mesh file may have been moved since.
Scenario load_flown_scenario(const std::string& path);

/// Whether the file, written by to_yaml() of this version or of 0.1, holds this configuration.
bool is_written_in(const std::string& path, const Scenario& scenario);

/// A value given over those of the scenario file.
struct Override {
  std::string text;      // KEY=VALUE, the value in YAML
  std::string source{};  // as errors show it; "" = "--set TEXT"
  std::string folder{};  // where its relative paths begin; "" = the current folder
};

/// Fills in values of a scenario that was read, before they are checked against each other.
/// `is_given` says whether an override, rather than the file, gave a key or one below it.
struct Filling {
  std::string source;  // as errors of what was filled in show it
  std::function<void(Scenario&, const std::function<bool(std::string_view)>& is_given)> fill;
};

/// load_scenario() with overrides that were not given on the command line, and perhaps with values
/// that depend on the rest: a filling's come last, and throw BadInput when they cannot be had.
/// `unused_notes` gets a sentence for each key that was given and has no effect, but for those of a
/// built-in file: "key (where) has no effect: other key is value".
Scenario load_with_overrides(const std::string& name_or_path,
                             const std::vector<Override>& overrides, const Filling& filling = {},
                             std::vector<std::string>* unused_notes = nullptr);

/// The override that gives these views: `planner.routes.views=[...]`. They read back bit for bit.
std::string views_override(std::span<const ViewPose> views);

/// The resolved configuration as YAML, every key with its value and absolute paths: load_scenario
/// on it gives the same Scenario, bit for bit, if load_scenario made it. (An angle set by other
/// means may lie between two numbers of degrees and lands on one of them.)
std::string to_yaml(const Scenario& scenario);

/// Every value with the path of its key ("cameras.0.range_max_m"), as YAML, in the order of the
/// file. "path=text" is an override that load_scenario takes.
std::vector<std::pair<std::string, std::string>> scenario_values(const Scenario& scenario);

/// What its values are compared with: the defaults of every key, for as many sensors as it has.
Scenario usual_beside(const Scenario& scenario);

/// Whether the scenario has the values of the built-in scenario of its name, which are the paper's,
/// wherever fields_*.cpp say that they belong to the paper's setting; only then may a mission's
/// figures stand beside the paper's. The structure is not asked, since it may be a file, nor are
/// the switches, each a reading of the paper.
bool has_papers_setting(const Scenario& scenario);

/// JSON schema (draft 7) of the scenario file, for editors: types, ranges, names, meanings.
std::string scenario_json_schema();

}  // namespace gnbv
