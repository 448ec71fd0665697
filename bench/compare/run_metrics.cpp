#include "bench/compare/run_metrics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "bench/score/run_figures.hpp"
#include "bench/score/voxel_set.hpp"
#include "sim/core/error.hpp"

namespace gnbv {
namespace {

using Value = std::optional<double>;

template <std::size_t size>
Value coverage_percent(const RunFigures& run, const MetricContext&) {
  return 100.0 * run.coverage_final[size];
}

Value share_percent(const RunFigures& run, const MetricContext& context) {
  if (!context.ceiling || context.ceiling->leaf_outside[0] <= 0.0) return std::nullopt;
  return 100.0 * run.coverage_final[0] / context.ceiling->leaf_outside[0];
}

template <Effort effort>
Value area_percent(const RunFigures& run, const MetricContext& context) {
  const double budget = context.budgets[static_cast<std::size_t>(effort)];
  if (budget <= 0.0) return std::nullopt;
  return 100.0 * area_under_coverage(run.curve, effort, 0, budget);
}

/// Runs that were scored by an older version have no distances.
bool has_distances(const RunFigures& run) { return run.distances.at[1].distance_m > 0.0; }

Value f_percent(const RunFigures& run, const MetricContext&) {
  return has_distances(run) ? Value(100.0 * run.distances.at[1].f) : std::nullopt;
}

Value chamfer_mm(const RunFigures& run, const MetricContext&) {
  return has_distances(run) ? Value(1000.0 * run.distances.chamfer_m) : std::nullopt;
}

template <std::size_t share, double EffortSpent::*spent>
Value effort_to(const RunFigures& run, const MetricContext& context) {
  if (!context.ceiling || context.ceiling->leaf_outside[0] <= 0.0 || run.curve.coverage.empty()) {
    return std::nullopt;
  }
  const auto effort = effort_to_reach(run.curve, run.before,
                                      kReachShares[share] * context.ceiling->leaf_outside[0]);
  return effort ? (*effort).*spent : std::numeric_limits<double>::infinity();
}

template <std::size_t share>
void add_efforts(std::vector<RunMetric>& metrics) {
  const std::string to = fmt::format("to {:.0f} % of ceiling", 100.0 * kReachShares[share]);
  metrics.push_back({"views " + to, false, 1, effort_to<share, &EffortSpent::views>, true});
  metrics.push_back({"metres " + to, false, 1, effort_to<share, &EffortSpent::metres>, true});
  metrics.push_back({"metres " + to + ", with profile", false, 1,
                     effort_to<share, &EffortSpent::metres_with_profile>, true});
  metrics.push_back({"seconds " + to + ", with profile", false, 1,
                     effort_to<share, &EffortSpent::seconds_with_profile>, true});
}

template <std::size_t... shares>
void add_all_efforts(std::vector<RunMetric>& metrics, std::index_sequence<shares...>) {
  (add_efforts<shares>(metrics), ...);
}

static_assert(kCoverageSizes_m == std::array<double, 3>{0.05, 0.10, 0.50});
static_assert(kScoreDistances_m[1] == 0.05);

std::vector<RunMetric> make_metrics() {
  std::vector<RunMetric> metrics = {
      {std::string(kCoverageMetric), true, 1, coverage_percent<0>},
      {"coverage at 0.10 m (%)", true, 1, coverage_percent<1>},
      {"coverage at 0.50 m (%)", true, 1, coverage_percent<2>},
      {"share of ceiling at 0.05 m (%)", true, 1, share_percent},
      {"AUC over views (%)", true, 1, area_percent<Effort::views>},
      {"AUC over metres (%)", true, 1, area_percent<Effort::metres>},
      {"AUC over seconds (%)", true, 1, area_percent<Effort::seconds>},
      {"F at 0.05 m (%)", true, 1, f_percent},
      {"Chamfer distance (mm)", false, 2, chamfer_mm},
      {"density (points/voxel)", true, 1,
       [](const RunFigures& run, const MetricContext&) -> Value {
         return run.density_points_per_voxel;
       }},
      {"entropy reduction (nat)", true, 0,
       [](const RunFigures& run, const MetricContext&) -> Value {
         return run.entropy_reduction_nat;
       }},
      {"views", false, 1,
       [](const RunFigures& run, const MetricContext&) -> Value { return run.iterations; }},
      {std::string(kDistanceMetric), false, 1,
       [](const RunFigures& run, const MetricContext&) -> Value { return run.straight_m; }},
      {"flight time (s)", false, 1,
       [](const RunFigures& run, const MetricContext&) -> Value { return run.flight_time_s; }},
  };
  add_all_efforts(metrics, std::make_index_sequence<kReachShares.size()>());
  return metrics;
}

}  // namespace

std::span<const RunMetric> run_metrics() {
  static const std::vector<RunMetric> metrics = make_metrics();
  return metrics;
}

std::vector<RunMetric> metrics_of(std::span<const RunFigures* const> runs) {
  std::vector<RunMetric> metrics(run_metrics().begin(), run_metrics().end());
  std::set<double> sizes_m;
  for (const RunFigures* run : runs) {
    for (const SizedCoverage& at : run->more) sizes_m.insert(at.size_m);
  }
  for (const double size_m : sizes_m) {
    metrics.push_back({fmt::format("coverage at {} m (%)", size_name(size_m)), true, 1,
                       [size_m](const RunFigures& run, const MetricContext&) -> Value {
                         for (const SizedCoverage& at : run.more) {
                           if (at.size_m == size_m) return 100.0 * at.final;
                         }
                         return std::nullopt;
                       }});
  }
  return metrics;
}

std::size_t metric_index(std::string_view name) {
  const std::span<const RunMetric> metrics = run_metrics();
  const auto metric = std::find_if(metrics.begin(), metrics.end(),
                                   [&](const RunMetric& m) { return m.name == name; });
  GNBV_CHECK(metric != metrics.end(), "no metric '{}'", name);
  return static_cast<std::size_t>(metric - metrics.begin());
}

std::array<double, 3> common_budgets(std::span<const RunFigures* const> runs) {
  std::array<double, 3> budgets{};
  for (const RunFigures* run : runs) {
    if (run->curve.coverage.empty()) return {};
    budgets[0] = std::max(budgets[0], static_cast<double>(run->curve.views()));
    budgets[1] = std::max(budgets[1], run->curve.metres.back());
    budgets[2] = std::max(budgets[2], run->curve.seconds.back());
  }
  return budgets;
}

}  // namespace gnbv
