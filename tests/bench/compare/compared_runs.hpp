// Missions made by hand, and what a comparison of them says.
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "bench/compare/comparison.hpp"

namespace gnbv {

struct ComparedRun {
  std::string scenario;
  std::string method;
  std::uint64_t seed = 0;
  RunFigures figures = {};
  bool is_noisy = false;
};

/// By scenario.
using Ceilings = std::map<std::string, Ceiling>;

/// Within the budgets of the longest run of each scenario.
inline Comparison compare(std::vector<ComparedRun> runs, const std::string& baseline,
                          const Ceilings& ceilings) {
  std::map<std::string, Budgets> budgets;
  for (const ComparedRun& run : runs) {
    const CoverageCurve& curve = run.figures.curve;
    for (std::size_t i = 0; i < Budgets{}.size() && !curve.coverage.empty(); ++i) {
      double& budget = budgets[run.scenario][i];
      budget = std::max(budget, effort_at(curve, {}, kEfforts[i], curve.views()));
    }
  }
  std::vector<MissionRow> rows;
  for (ComparedRun& run : runs) {
    run.figures.budgets = budgets[run.scenario];
    MissionRow& row = rows.emplace_back(mission_row(run.figures));
    row.scenario = run.scenario;
    row.method = run.method;
    row.seed = run.seed;
    row.figures["seeds_key_noise"] = run.is_noisy ? 1.0 : 0.0;
    const auto ceiling = ceilings.find(run.scenario);
    if (ceiling != ceilings.end()) add_ceiling(run.figures, ceiling->second, row);
  }
  return compare(rows, baseline);
}

inline ComparedRun run(const std::string& method, std::uint64_t seed, double coverage,
                       double metres, const std::string& scenario = "aircraft") {
  ComparedRun r{scenario, method, seed, {}};
  r.figures.coverage_final = {coverage, coverage, coverage};
  r.figures.straight_m = metres;
  r.figures.iterations = 2;
  r.figures.curve = {.coverage = {{0.0, 0.0, 0.0}, {coverage, 0.0, 0.0}},
                     .metres = {0.0, metres},
                     .seconds = {0.0, 10.0}};
  return r;
}

/// A run that covers a tenth of the ceiling more with each of its views of 10 m.
inline ComparedRun climbing(const std::string& method, std::uint64_t seed, int views,
                            double metres) {
  ComparedRun r = run(method, seed, 0.1 * views, metres * views);
  r.figures.curve = {};
  for (int view = 0; view <= views; ++view) {
    r.figures.curve.coverage.push_back({0.1 * view + 1e-9, 0.0, 0.0});
    r.figures.curve.metres.push_back(metres * view);
    r.figures.curve.seconds.push_back(view);
  }
  r.figures.before = {.profile_m = 100.0, .transfer_m = 5.0, .profile_end_s = 60.0};
  return r;
}

constexpr std::string_view kTo90 = "metres to 90 % of ceiling";

inline Ceilings ceiling_at(double coverage, const std::string& scenario = "aircraft") {
  Ceilings one;
  one[scenario].leaf_counted = {coverage, 1.0, 1.0};
  return one;
}

inline bool notes_say(const Comparison& comparison, std::string_view words) {
  const TextTable table = comparison_table(comparison);
  return std::any_of(table.notes.begin(), table.notes.end(), [&](const std::string& note) {
    return note.find(words) != std::string::npos;
  });
}

}  // namespace gnbv
