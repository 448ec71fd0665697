// The suite: fixed tasks with frozen numbers, in tracks. A changed number is a new version.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/score/run_figures.hpp"

namespace gnbv {

/// What is flown around, and where from.
struct SuiteStructure {
  std::string name;
  std::string set;                         // "paper", "public" or "held_out"
  std::string scenario;                    // built in
  std::string random = {};                 // its kind; "": the scenario's own structure
  std::uint64_t seed = 0;                  // of a random one
  int draw = 0;                            // from Suite::drawn_from; 0: the seed was chosen
  std::string sha256 = {};                 // of the mesh as it is flown around; "": not frozen yet
  std::vector<std::string> settings = {};  // KEY=VALUE of the scenario: workspace, start

  bool operator==(const SuiteStructure&) const = default;
};

struct SuiteTrack {
  std::string name, what;
  Effort effort = Effort::metres;  // what is budgeted: metres, or seconds from take-off
  std::vector<std::string> free =
      {};  // keys a planner may set, beside kFreeKeys, with all below them
  std::vector<std::string> settings = {};  // KEY=VALUE; `cameras.*` is every camera

  bool operator==(const SuiteTrack&) const = default;
};

/// A structure in a track. Coverage is accurate coverage at 0.05 m (kAccurateShare).
struct SuiteTask {
  std::string track, structure;
  double budget = 0.0;                 // of the track's effort
  std::optional<double> ceiling = {};  // coverage that the cloud can hold; none: not frozen yet
  std::optional<double> best = {};     // mean coverage over the budget of the best known planner
  std::string best_planner = {};

  bool is_frozen() const { return ceiling && best; }
  bool operator==(const SuiteTask&) const = default;
};

struct Suite {
  int version = 1;
  std::string drawn_from = {};  // the frozen commit that held-out seeds follow from
  std::vector<SuiteStructure> structures = {};
  std::vector<SuiteTrack> tracks = {};
  std::vector<SuiteTask> tasks = {};

  /// Throws BadInput naming the tracks that there are.
  const SuiteTrack& track(std::string_view name) const;
  const SuiteStructure& structure_of(const SuiteTask& task) const;
  std::vector<SuiteTask> tasks_of(std::string_view track) const;

  bool operator==(const Suite&) const = default;
};

/// The keys of a scenario that an entry may set, each with all below it: how views are chosen.
/// Never a sensor, the map, the cloud, or what is safe.
extern const std::vector<std::string_view> kFreeKeys;

/// Reads a suite; `file` is what faults name. Throws BadInput with all of them, each with its line:
/// keys, types, names that stand twice or are unknown, seeds that do not follow from the rule.
Suite read_suite(const std::string& text, const std::string& file);
/// suite/v1.yaml, as it was when the program was built.
std::string_view builtin_suite();
/// The text that read_suite() reads as the same.
std::string suite_yaml(const Suite& suite);

/// SHA-256 of the text of the suite with this track alone: what a result is a result of.
std::string track_sha256(const Suite& suite, std::string_view track);

}  // namespace gnbv
