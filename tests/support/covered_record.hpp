// Runs with a curve of coverage, for plots and groups.
#pragma once

#include <vector>

#include "tests/support/made_run.hpp"

namespace gnbv {

/// A run whose coverage after `views` views is given; each view takes 2 m and 5 s.
inline RunRecord covered_record(std::uint64_t seed, const std::vector<double>& coverage) {
  RunRecord record = made_record();
  record.scenario.seed = seed;
  record.figures.emplace();
  record.figures->scenario = "smoke";
  record.figures->utility = record.scenario.planner.utility.name;
  for (std::size_t i = 0; i < coverage.size(); ++i) {
    record.figures->curve.coverage.push_back({coverage[i], 1.0, 1.0});
    record.figures->curve.metres.push_back(2.0 * static_cast<double>(i));
    record.figures->curve.seconds.push_back(5.0 * static_cast<double>(i));
  }
  return record;
}

}  // namespace gnbv
