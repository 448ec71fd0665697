// Runs that belong together, and how people tell them apart.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "tools/figures/looks.hpp"
#include "tools/run/run_record.hpp"

namespace gnbv {

/// Runs that differ in their seeds alone.
struct RunGroup {
  std::string label;  // what tells it from the other groups: scenario, utility, preset; then keys
  std::vector<const RunRecord*> runs;
  SeriesLook look = {};
};

/// Runs with figures, grouped by their whole configuration without the seed, in the order of their
/// first ones. A run of a group and seed that is there already is left out and named in `notes`.
std::vector<RunGroup> group_runs(std::span<const RunRecord> runs, std::vector<std::string>& notes);
std::vector<RunGroup> group_runs(std::span<const RunRecord* const> runs,
                                 std::vector<std::string>& notes);

/// What tells each group from the others beside its utility: a preset, keys. Empty for all when
/// nothing does.
std::vector<std::string> setting_labels(std::span<const RunGroup> groups);

/// Of each run: its title, then as far as others share that, the keys in which they differ, its
/// seed, as much of its folder's end as tells them apart.
std::vector<std::string> run_labels(std::span<const RunRecord> runs);

/// A name for each run directory, in their order: that of the folder, however its path is written
/// ("x/run/" and "." have names, too). A number follows where two are named alike: run, run-2.
std::vector<std::string> run_names(std::span<const std::filesystem::path> folders);

/// The method of a run, as method_slots() knows it: the utility, or the preset that stands for the
/// released code.
std::string method_of(const RunRecord& run);

/// The scenario of all of them, for people; nothing where they have several. Requires a group.
std::string common_scenario(std::span<const RunGroup> groups);

/// What a legend says of a group below that title: "Proposed".
std::string label_below(std::string_view title, const std::string& label);

}  // namespace gnbv
