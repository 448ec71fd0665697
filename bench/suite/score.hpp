// What a mission scores in a task, and what a track's score is.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "bench/score/run_figures.hpp"
#include "bench/suite/suite.hpp"

namespace gnbv {

/// Of one mission in one task; coverage is accurate coverage at 0.05 m, in fractions.
struct TaskFigures {
  std::string task;  // name of its structure
  std::string termination, result_sha256;
  std::uint64_t views = 0;
  double spent = 0.0;                // of the track's effort, at the last view
  double integral = 0.0;             // mean coverage over the budget
  double share = 0.0;                // of what the best known planner gets: the score
  double coverage = 0.0;             // by the last view within the budget
  std::optional<double> to_90 = {};  // effort at which that share of the ceiling was covered,
  std::optional<double> to_95 = {};  // within the budget
  double plan_s = 0.0;               // wall time of planning a view: stated, not recomputed

  bool operator==(const TaskFigures&) const = default;
};

/// Whether a mission ended so that nothing more counts: the vehicle hit something or was lost.
bool is_lost(const std::string& termination);

/// Mean coverage over [0, budget] of the effort: a view counts from where it was taken, nothing
/// before the first entry. Up to the last entry alone when the mission was lost there.
double mean_coverage(const CoverageCurve& curve, const BeforeViews& before, Effort effort,
                     double budget, bool is_lost);

/// Requires a frozen task of that effort, and a run with accurate coverage.
TaskFigures task_figures(const RunFigures& run, const SuiteTask& task, Effort effort);

/// A mean over structures, and the 95 % percentile interval of it over 10,000 resamples of them
/// (Efron 1979). The interval of one structure is the mean itself. The same numbers every time.
struct Interval {
  double mean = 0.0, low = 0.0, high = 0.0;
};
Interval bootstrap_mean(std::span<const double> values);

}  // namespace gnbv
