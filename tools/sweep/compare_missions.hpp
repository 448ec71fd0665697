// The missions of `gnbv compare`, and what their statistics say.
#pragma once

#include "tools/mission/resolve.hpp"
#include "tools/sweep/bench_runs.hpp"

namespace gnbv {

/// What --utilities, --presets, --variant and --vary name.
struct MethodOptions {
  std::vector<std::string> utilities{};
  std::vector<std::string> presets{};
  std::vector<std::string> variants{};  // [NAME:]KEY=VALUE[,KEY=VALUE]...
  std::vector<std::string> varies{};    // KEY=VALUE[,VALUE]...: a method a value
};

/// In the order of the options above: a utility is named as named_methods() does, a preset as it
/// is, a variant by its NAME or its text, a varied value by KEY=VALUE. When only variants are
/// named, the scenario as it is, "default", stands first. Commas within brackets, braces or quotes
/// separate nothing. Throws BadInput with every fault at once: text that is none of this, a name
/// that stands twice, a seed, fewer than two methods. Keys and values are checked by cells_of().
std::vector<SweepMethod> methods_of(const MethodOptions& options);

struct CompareRequest {
  ScenarioOptions structure;  // of every scenario
  std::vector<std::string> scenarios;
  MethodOptions methods;
  std::filesystem::path views;                   // of the method `route`
  std::string baseline;                          // "" is the first method
  std::filesystem::path sweep = {};              // file whose missions are flown; "": see above
  std::vector<std::filesystem::path> from = {};  // folder of a sweep, or files of rows; none flies
};

struct ComparedMissions {
  BenchRuns flown;
  Comparison comparison = {};
  BenchTables bench = {};
};

/// Flies every method in every scenario over the seeds, or reads what a sweep flew. Throws BadInput
/// with what cannot be compared before anything is flown, CommandFailed when no mission of the
/// baseline is done.
ComparedMissions compare_missions(const CompareRequest& request, const BenchOptions& options);

}  // namespace gnbv
