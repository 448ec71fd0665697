// The missions of `gnbv table`, and its tables.
#pragma once

#include "tools/mission/resolve.hpp"
#include "tools/sweep/bench_runs.hpp"

namespace gnbv {

struct TableRequest {
  ScenarioOptions scenario;
  std::vector<std::string> utilities = {};  // rows beside the paper's
  bool no_oracle = false;
  std::vector<std::filesystem::path> from = {};  // files of rows, which are not flown again
};

/// Flies every row of the paper's table of the scenario, the user's rows, the tour and the oracles,
/// those of few metres and seconds once more for each share of the ceiling; what lies above the
/// ceiling once more without noise. Or takes the rows that are there. Three tables, or one with the
/// columns of all
/// for programs. Throws BadInput for a scenario that the paper has no table of.
BenchTables table_of_missions(const TableRequest& request, const BenchOptions& options);

}  // namespace gnbv
