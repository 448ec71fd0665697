#include <algorithm>

#include "bench/compare/statistics.hpp"
#include "bench/suite/submission.hpp"
#include "sim/core/error.hpp"
#include "sim/core/rng.hpp"

namespace gnbv {
namespace {

constexpr std::size_t kResamples = 10'000;

std::optional<double> effort_to(const CoverageCurve& curve, const BeforeViews& before,
                                Effort effort, double coverage, double budget) {
  for (std::size_t i = 0; i < curve.accurate.size(); ++i) {
    if (curve.accurate[i][0] < coverage) continue;
    const double spent = effort_at(curve, before, effort, i);
    return spent <= budget ? std::optional(spent) : std::nullopt;
  }
  return std::nullopt;
}

}  // namespace

bool is_lost(const std::string& termination) {
  return termination == "collision" || termination == "off_course" ||
         termination == "utility_failed";
}

double mean_coverage(const CoverageCurve& curve, const BeforeViews& before, Effort effort,
                     double budget, bool is_lost) {
  GNBV_CHECK(budget > 0.0 && !curve.accurate.empty(), "budget {} of {} entries", budget,
             curve.accurate.size());
  double area = 0.0, at = 0.0, coverage = 0.0;
  for (std::size_t i = 0; i < curve.accurate.size() && at < budget; ++i) {
    const double next = std::min(effort_at(curve, before, effort, i), budget);
    area += (next - at) * coverage;
    at = next;
    coverage = curve.accurate[i][0];
  }
  if (!is_lost) area += (budget - at) * coverage;
  return area / budget;
}

TaskFigures task_figures(const RunFigures& run, const SuiteTask& task, Effort effort) {
  GNBV_CHECK(task.is_frozen() && !run.curve.accurate.empty(), "{} in {}: {} entries",
             task.structure, task.track, run.curve.accurate.size());
  const CoverageCurve& curve = run.curve;
  TaskFigures figures{.task = task.structure,
                      .termination = run.termination,
                      .result_sha256 = run.result_sha256,
                      .views = curve.views(),
                      .spent = effort_at(curve, run.before, effort, curve.views())};
  figures.integral =
      mean_coverage(curve, run.before, effort, task.budget, is_lost(run.termination));
  figures.share = figures.integral / *task.best;
  for (std::size_t i = 0; i < curve.accurate.size(); ++i) {
    if (effort_at(curve, run.before, effort, i) > task.budget) break;
    figures.coverage = curve.accurate[i][0];
  }
  figures.to_90 = effort_to(curve, run.before, effort, 0.90 * *task.ceiling, task.budget);
  figures.to_95 = effort_to(curve, run.before, effort, 0.95 * *task.ceiling, task.budget);
  return figures;
}

Interval bootstrap_mean(std::span<const double> values) {
  GNBV_CHECK(!values.empty(), "a mean of nothing");
  std::vector<double> means(kResamples);
  for (std::size_t i = 0; i < kResamples; ++i) {
    double sum = 0.0;
    for (std::size_t k = 0; k < values.size(); ++k) {
      sum += values[mix_bits(mix_bits(i) ^ k) % values.size()];
    }
    means[i] = sum / static_cast<double>(values.size());
  }
  std::ranges::sort(means);
  return {mean_of(values), means[kResamples / 40], means[kResamples - 1 - kResamples / 40]};
}

}  // namespace gnbv
