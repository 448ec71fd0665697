// The missions of `gnbv compare`, and what their statistics say.
#pragma once

#include "tools/mission/resolve.hpp"
#include "tools/sweep/bench_runs.hpp"
#include "tools/sweep/method_options.hpp"

namespace gnbv {

struct CompareRequest {
  ScenarioOptions structure;  // of every scenario
  std::vector<std::string> scenarios;
  MethodOptions methods;
  std::filesystem::path views;  // of the method `route`
  std::string baseline;         // "" is the first method
  std::filesystem::path from;   // of a sweep; "" flies
  bool no_ceiling = false;
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
