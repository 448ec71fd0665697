#include "bench/compare/run_metrics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>

#include "bench/score/run_figures.hpp"
#include "bench/score/voxel_set.hpp"

namespace gnbv {
namespace {

using Value = std::optional<double>;
using Context = MetricContext;

static_assert(kScoreDistances_m[1] == 0.05);

/// A figure that every run has.
template <typename Number>
auto figure(Number RunFigures::*number) {
  return [=](const RunFigures& run, const Context&) -> Value { return run.*number; };
}

auto coverage_percent(std::size_t size) {
  return [=](const RunFigures& run, const Context&) -> Value {
    return 100.0 * run.coverage_final[size];
  };
}

Value accurate_percent(const RunFigures& run, const Context&) {
  if (!run.coverage_accurate) return std::nullopt;
  return 100.0 * run.coverage_accurate->front();
}

auto area_percent(Effort effort) {
  return [=](const RunFigures& run, const Context& context) -> Value {
    const double budget = context.budgets[static_cast<std::size_t>(effort)];
    if (budget <= 0.0) return std::nullopt;
    return 100.0 * area_under_coverage(run.curve, effort, 0, budget);
  };
}

/// Runs that were scored by an older version have no distances.
auto distance_score(double factor, double (*of)(const CloudDistances&)) {
  return [=](const RunFigures& run, const Context&) -> Value {
    if (run.distances.at[1].distance_m <= 0.0) return std::nullopt;
    return factor * of(run.distances);
  };
}

auto effort_to(double share, double EffortSpent::*spent) {
  return [=](const RunFigures& run, const Context& context) -> Value {
    if (context.most() <= 0.0 || run.curve.coverage.empty()) return std::nullopt;
    const auto effort = effort_to_reach(run.curve, run.before, share * context.most());
    return effort ? (*effort).*spent : std::numeric_limits<double>::infinity();
  };
}

Value share_percent(const RunFigures& run, const Context& context) {
  if (context.most() <= 0.0) return std::nullopt;
  return 100.0 * run.coverage_final[0] / context.most();
}

Value sized_coverage_percent(const RunFigures& run, double size_m) {
  for (const SizedCoverage& at : run.more) {
    if (at.size_m == size_m) return 100.0 * at.final;
  }
  return std::nullopt;
}

}  // namespace

std::vector<RunMetric> metrics_of(std::span<const RunFigures* const> runs) {
  std::vector<RunMetric> metrics = {
      {std::string(kCoverageMetric), true, 1, coverage_percent(0)},
      {"coverage at 0.10 m (%)", true, 1, coverage_percent(1)},
      {"coverage at 0.50 m (%)", true, 1, coverage_percent(2)},
      {"accurate coverage at 0.05 m (%)", true, 1, accurate_percent},
      {"share of ceiling at 0.05 m (%)", true, 1, share_percent},
      {"AUC over views (%)", true, 1, area_percent(Effort::views)},
      {"AUC over metres (%)", true, 1, area_percent(Effort::metres)},
      {"AUC over seconds (%)", true, 1, area_percent(Effort::seconds)},
      {"F at 0.05 m (%)", true, 1, distance_score(100.0, [](const auto& d) { return d.at[1].f; })},
      {"Chamfer distance (mm)", false, 2,
       distance_score(1000.0, [](const auto& d) { return d.chamfer_m; })},
      {"density (points/voxel)", true, 1, figure(&RunFigures::density_points_per_voxel)},
      {"entropy reduction (nat)", true, 0, figure(&RunFigures::entropy_reduction_nat)},
      {"views", false, 1, figure(&RunFigures::iterations)},
      {std::string(kDistanceMetric), false, 1, figure(&RunFigures::straight_m)},
      {"flight time (s)", false, 1, figure(&RunFigures::flight_time_s)},
  };
  for (const double share : kReachShares) {
    const std::string to = fmt::format(" to {:.0f} % of ceiling", 100.0 * share);
    const auto add = [&](const std::string& name, double EffortSpent::*spent) {
      metrics.push_back({name, false, 1, effort_to(share, spent)});
    };
    add("views" + to, &EffortSpent::views);
    add("metres" + to, &EffortSpent::metres);
    add("metres" + to + ", with profile", &EffortSpent::metres_with_profile);
    add("seconds" + to + ", with profile", &EffortSpent::seconds_with_profile);
  }
  std::set<double> sizes_m;
  for (const RunFigures* run : runs) {
    for (const SizedCoverage& at : run->more) sizes_m.insert(at.size_m);
  }
  for (const double size_m : sizes_m) {
    metrics.push_back({fmt::format("coverage at {} m (%)", size_name(size_m)), true, 1,
                       [size_m](const RunFigures& run, const Context&) {
                         return sized_coverage_percent(run, size_m);
                       }});
  }
  return metrics;
}

std::array<double, 3> common_budgets(std::span<const RunFigures* const> runs) {
  std::array<double, 3> budgets{};
  for (const RunFigures* run : runs) {
    if (run->curve.coverage.empty()) return {};
    for (const Effort effort : {Effort::views, Effort::metres, Effort::seconds}) {
      double& budget = budgets[static_cast<std::size_t>(effort)];
      budget = std::max(budget, effort_at(run->curve, effort, run->curve.views()));
    }
  }
  return budgets;
}

}  // namespace gnbv
