// The figures of a run that methods are compared by, each with its unit and which way is better.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/limits/ceiling.hpp"
#include "bench/score/run_figures.hpp"

namespace gnbv {

/// What a figure is relative to, the same for all runs of a scenario.
struct MetricContext {
  std::optional<Ceiling> ceiling = {};
  std::array<double, 3> budgets = {};  // of views, metres, seconds: the longest run's; 0 for none

  /// Coverage at 0.05 m; 0 where it is not known.
  double most() const { return ceiling ? ceiling->leaf_counted[0] : 0.0; }
};

struct RunMetric {
  std::string name;  // with the unit of the value
  bool higher_is_better = true;
  int decimals = 1;
  /// Infinite for an effort to reach what a run did not get to; nothing where it is not known.
  std::function<std::optional<double>(const RunFigures& run, const MetricContext& context)> value;
  /// Whether a method can be better by it. Nobody is for ending early, nor for reducing entropy.
  bool is_judged = true;
  /// Of an effort what a run that used up the budget has spent; nothing where there is no budget.
  decltype(value) limit = {};
};

constexpr std::string_view kCoverageMetric = "coverage at 0.05 m (%)";
constexpr std::string_view kDistanceMetric = "distance (m)";

/// In the order of tables: coverage at 0.05 m first, then the others that every run has, the
/// efforts to reach kReachShares of the ceiling, and the coverage at each size that any of the runs
/// has beside the paper's, ascending.
std::vector<RunMetric> metrics_of(std::span<const RunFigures* const> runs);

/// The budgets common to all runs: the longest of them by each effort. 0 where a run has no curve,
/// since nothing can be compared then.
std::array<double, 3> common_budgets(std::span<const RunFigures* const> runs);

}  // namespace gnbv
