// Curves over effort, and their means over runs.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "bench/compare/statistics.hpp"
#include "bench/score/run_figures.hpp"
#include "tools/figures/groups.hpp"

namespace gnbv {

/// A value that changes at each x and stays until the next: surface counts from the view that saw
/// it. After the last x it stays what it was, also where other runs go on.
struct StepCurve {
  std::vector<double> x;  // ascending; of equal ones the last counts
  std::vector<double> y;

  /// Requires an entry. Before the first x it is the first y.
  double at(double x_there) const;
};

/// Coverage (%) at one voxel size over what was spent since the first view, so that the way there
/// from the profile is in neither metres nor seconds; or from take-off. Nothing for a run that was
/// not scored at it, or of which the effort is not known.
std::optional<StepCurve> coverage_steps(const RunFigures& figures, Effort effort, double size_m);

/// Values after each view, the first at 1.
StepCurve steps_over_views(std::vector<double> values);

/// The mean over runs at each x where one of them changes, or at 1,000 even ones where these are
/// more, up to the end of the longest.
struct MeanCurve {
  std::vector<double> x;
  std::vector<MeanEstimate> y;
  double end_x = 0.0;  // the mean of their ends,
  double end_y = 0.0;  // and the mean curve there
  double shortest_x = 0.0;
  double longest_x = 0.0;
};

/// Requires a curve, and an entry in each.
MeanCurve mean_curve(std::span<const StepCurve> curves);

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

}  // namespace gnbv
