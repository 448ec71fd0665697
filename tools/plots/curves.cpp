#include "tools/plots/curves.hpp"

#include <algorithm>
#include <cmath>

#include "bench/score/effort_to_reach.hpp"
#include "sim/core/error.hpp"

namespace gnbv {

std::vector<Phase> frontier_phases(std::span<const ViewRecord> views) {
  std::vector<Phase> phases;
  bool is_open = false;
  for (const ViewRecord& view : views) {
    const bool is_frontier = traits_of(view.decision.sampler).at_frontier;
    if (is_frontier && !is_open) phases.push_back({view.iteration, view.iteration});
    if (is_frontier) phases.back().last = view.iteration;
    is_open = is_frontier;
  }
  return phases;
}

std::vector<double> moving_mean(std::span<const double> values, std::size_t window) {
  GNBV_CHECK(window % 2 == 1, "a window of {}", window);
  std::vector<double> means;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t reach = std::min({window / 2, i, values.size() - 1 - i});
    std::vector<double> known;
    for (const double value : values.subspan(i - reach, 2 * reach + 1)) {
      if (!std::isnan(value)) known.push_back(value);
    }
    means.push_back(known.empty() ? values[i] : mean_of(known));
  }
  return means;
}

double spent_at(const CoverageCurve& curve, Effort effort, std::size_t entry) {
  return effort == Effort::seconds ? seconds_of_views(curve, entry)
                                   : effort_at(curve, effort, entry);
}

double whole_effort(const CoverageCurve& curve, Effort effort) {
  return spent_at(curve, effort, curve.views());
}

double coverage_at(const CoverageCurve& curve, Effort effort, std::size_t size, double at) {
  std::size_t next = 0;
  while (next < curve.coverage.size() && spent_at(curve, effort, next) <= at) ++next;
  if (next == 0) return curve.coverage.front()[size];
  const double before = curve.coverage[next - 1][size];
  if (next == curve.coverage.size()) return before;
  const double begin = spent_at(curve, effort, next - 1);
  const double share = (at - begin) / (spent_at(curve, effort, next) - begin);
  return before + share * (curve.coverage[next][size] - before);
}

CoveragePoint mean_end(const RunGroup& group, Effort effort, std::size_t size) {
  std::vector<double> efforts;
  for (const RunRecord* const run : group.runs)
    efforts.push_back(whole_effort(run->figures->curve, effort));
  const double at = mean_of(efforts);
  std::vector<double> shares;
  for (const RunRecord* const run : group.runs)
    shares.push_back(coverage_at(run->figures->curve, effort, size, at));
  return {at, estimate_mean(shares)};
}

std::vector<CoveragePoint> mean_coverage(const RunGroup& group, Effort effort, std::size_t size) {
  constexpr std::size_t kSteps = 200;
  double longest = 0.0;
  std::size_t most_views = 0;
  for (const RunRecord* run : group.runs) {
    longest = std::max(longest, whole_effort(run->figures->curve, effort));
    most_views = std::max(most_views, run->figures->curve.views());
  }
  const bool is_single = group.runs.size() == 1;
  const bool by_views = is_single || effort == Effort::views || most_views == 0;
  const std::size_t steps = by_views ? most_views : kSteps;
  std::vector<CoveragePoint> points;
  for (std::size_t i = 0; i <= steps; ++i) {
    const double at = is_single ? spent_at(group.runs.front()->figures->curve, effort, i)
                                : longest * static_cast<double>(i) /
                                      static_cast<double>(std::max<std::size_t>(steps, 1));
    std::vector<double> shares;
    for (const RunRecord* run : group.runs) {
      // two views at one place take no metres: a run's own point is the view's
      shares.push_back(is_single ? run->figures->curve.coverage[i][size]
                                 : coverage_at(run->figures->curve, effort, size, at));
    }
    points.push_back({at, estimate_mean(shares)});
  }
  return points;
}

}  // namespace gnbv
