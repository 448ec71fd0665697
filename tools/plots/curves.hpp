// What plots are made of: series over views and coverage over effort, as numbers.
#pragma once

#include <span>
#include <vector>

#include "bench/compare/statistics.hpp"
#include "bench/score/run_figures.hpp"
#include "tools/run/run_groups.hpp"

namespace gnbv {

/// Consecutive views of one sampler, first and last iteration.
struct Phase {
  int first = 0;
  int last = 0;
};

/// The phases in which views were found at frontiers (sampler `fvs`).
std::vector<Phase> frontier_phases(std::span<const ViewRecord> views);

/// The mean of `window` values around each; fewer at the ends, the same number on both sides.
/// Those that are not known (NaN) do not count. Requires an odd window.
std::vector<double> moving_mean(std::span<const double> values, std::size_t window);

/// Coverage as a fraction at so much effort, straight between views; what it was at the last view
/// from then on. Requires a curve.
double coverage_at(const CoverageCurve& curve, Effort effort, std::size_t size, double at);

/// What an entry of the curve took. Metres and seconds both count from the first view on, so that
/// the way there from the profile is in neither. Requires such an entry.
double spent_at(const CoverageCurve& curve, Effort effort, std::size_t entry);

/// How much effort the whole curve took. Requires a curve.
double whole_effort(const CoverageCurve& curve, Effort effort);

/// One point of a mean curve.
struct CoveragePoint {
  double effort = 0.0;
  MeanEstimate coverage;  // fractions
};

/// The point of the group's mean curve at the mean of what its runs took in all.
CoveragePoint mean_end(const RunGroup& group, Effort effort, std::size_t size);

/// The curve of a group: one run's own points, or the mean over runs at every view, or at 201 even
/// steps of metres or seconds up to the longest run. A run that has ended keeps its coverage.
std::vector<CoveragePoint> mean_coverage(const RunGroup& group, Effort effort, std::size_t size);

}  // namespace gnbv
