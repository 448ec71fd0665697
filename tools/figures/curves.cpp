#include "tools/figures/curves.hpp"

#include <algorithm>
#include <cmath>

#include "sim/core/error.hpp"

namespace gnbv {

double StepCurve::at(double x_there) const {
  const auto after = std::upper_bound(x.begin(), x.end(), x_there) - x.begin();
  return y[static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - 1, 0))];
}

std::optional<StepCurve> coverage_steps(const RunFigures& figures, Effort effort, double size_m) {
  const CoverageCurve& curve = figures.curve;
  const std::optional<std::size_t> papers = papers_size(size_m);
  const auto more = std::find_if(figures.more.begin(), figures.more.end(),
                                 [&](const SizedCoverage& at) { return at.size_m == size_m; });
  if (curve.coverage.empty() || (!papers && more == figures.more.end())) return std::nullopt;
  if (!is_known(curve, effort)) return std::nullopt;
  StepCurve steps;
  for (std::size_t entry = 0; entry < curve.coverage.size(); ++entry) {
    steps.x.push_back(effort == Effort::seconds ? seconds_of_views(curve, entry)
                                                : effort_at(curve, figures.before, effort, entry));
    steps.y.push_back(100.0 * (papers ? curve.coverage[entry][*papers] : more->curve.at(entry)));
  }
  return steps;
}

StepCurve steps_over_views(std::vector<double> values) {
  StepCurve steps{.x = {}, .y = std::move(values)};
  for (std::size_t view = 1; view <= steps.y.size(); ++view) {
    steps.x.push_back(static_cast<double>(view));
  }
  return steps;
}

MeanCurve mean_curve(std::span<const StepCurve> curves) {
  constexpr std::size_t kMost = 1000;  // more than a column has pixels that can be told apart
  MeanCurve mean;
  std::vector<double> ends;
  for (const StepCurve& curve : curves) {
    GNBV_CHECK(!curve.x.empty() && curve.x.size() == curve.y.size(), "a curve of {} and {} entries",
               curve.x.size(), curve.y.size());
    mean.x.insert(mean.x.end(), curve.x.begin(), curve.x.end());
    ends.push_back(curve.x.back());
  }
  std::sort(mean.x.begin(), mean.x.end());
  mean.x.erase(std::unique(mean.x.begin(), mean.x.end()), mean.x.end());
  mean.shortest_x = *std::min_element(ends.begin(), ends.end());
  mean.longest_x = mean.x.back();
  mean.end_x = mean_of(ends);
  if (mean.x.size() > kMost) {
    const double first = mean.x.front();
    mean.x.resize(kMost);
    for (std::size_t i = 0; i < kMost; ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(kMost - 1);
      mean.x[i] = std::lerp(first, mean.longest_x, share);
    }
  }
  const auto estimate_at = [&](double x) {
    std::vector<double> values;
    for (const StepCurve& curve : curves) values.push_back(curve.at(x));
    return estimate_mean(values);
  };
  for (const double x : mean.x) mean.y.push_back(estimate_at(x));
  mean.end_y = estimate_at(mean.end_x).mean;
  return mean;
}

std::vector<Phase> frontier_phases(std::span<const ViewRecord> views) {
  std::vector<Phase> phases;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto is_frontier = [&](std::size_t k) {
      return traits_of(views[k].decision.sampler).at_frontier;
    };
    if (!is_frontier(i)) continue;
    if (i == 0 || !is_frontier(i - 1)) phases.push_back({.first = views[i].iteration});
    phases.back().last = views[i].iteration;
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

}  // namespace gnbv
