// Is A better than B here? Methods over seeds, with intervals and paired tests.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bench/compare/run_metrics.hpp"
#include "bench/compare/statistics.hpp"
#include "bench/compare/text_table.hpp"
#include "bench/score/run_figures.hpp"

namespace gnbv {

/// One mission in a comparison.
struct ComparedRun {
  std::string scenario;  // as the comparison names it
  std::string method;
  std::uint64_t seed = 0;
  RunFigures figures;
};

/// What the seeds say about a difference.
enum class Verdict {
  untested,         // one seed, or none, that both methods have
  equal,            // none of several seeds makes a difference
  not_significant,  // neither of the following
  interval_only,    // so few seeds that no test could reject; yet Student's interval of the mean
                    // difference excludes 0
  significant       // the signed-rank test rejects at 5 %, after Holm
};

/// A method against the baseline, over the seeds that both have. Where a run did not reach what the
/// metric asks for, it is worse than any that did, and as good as another that did not.
struct Contrast {
  std::size_t pairs = 0;
  std::size_t differing = 0;   // of these, whose difference is not 0: those the test ranks
  std::size_t family = 1;      // methods of this scenario and metric that Holm adjusts for
  double baseline_mean = 0.0;  // over the seeds of `difference`
  MeanEstimate difference;     // method - baseline, where both are finite; n = 0: nowhere
  bool is_above = false;       // whether the ranks of positive differences weigh more
  double p = 1.0;              // two-sided signed-rank test, over all pairs
  double p_holm = 1.0;         // adjusted over the methods of this scenario and metric
  Verdict verdict = Verdict::untested;
};

/// The least p that a contrast could have had, after Holm's first step; above 5 % its test cannot
/// reject, whatever the values.
double least_p_holm(const Contrast& contrast);

/// A method in a scenario by a metric.
struct MethodFigure {
  std::size_t scenario = 0;  // indices into Comparison's lists
  std::size_t metric = 0;
  std::size_t method = 0;
  std::size_t runs = 0;
  MeanEstimate estimate = {};             // over those that are finite; n = 0: none
  std::optional<double> rank = {};        // mean over the seeds that all methods have; 1 is best
  std::optional<Contrast> contrast = {};  // none for the baseline
};

/// Mean rank of a method by a metric over all scenarios and seeds that all methods have.
struct OverallRank {
  std::size_t metric = 0;
  std::size_t method = 0;
  std::size_t blocks = 0;
  double rank = 0.0;
};

struct Comparison {
  std::vector<RunMetric> metrics;  // metrics_of() all runs
  std::vector<std::string> scenarios;
  std::vector<std::size_t> area_samples;  // by scenario, of the reference: what coverage counts
  std::vector<std::string> methods;
  std::size_t baseline = 0;
  std::vector<std::array<double, 3>> budgets;  // by scenario: common_budgets()
  std::vector<MethodFigure> figures;  // by scenario, metric, method; without what nobody measured
  std::vector<OverallRank> ranks;
  /// A method, and the first one before it that flew the very same missions wherever both flew (by
  /// result_sha256): what sets the two apart has no effect.
  std::vector<std::array<std::size_t, 2>> same_missions = {};
};

/// By scenario and method: a method that changes a camera, the leaf or the workspace has a ceiling
/// of its own.
using Ceilings = std::map<std::pair<std::string, std::string>, Ceiling>;

/// Scenarios and methods in the order of their first runs. The ceilings as far as they are known.
/// Requires a run of the baseline, and no two runs of one scenario, method and seed.
Comparison compare(std::span<const ComparedRun> runs, const std::string& baseline,
                   const Ceilings& ceilings);

/// The figure of a method, if it has one.
const MethodFigure* find_figure(const Comparison& comparison, std::size_t scenario,
                                std::string_view metric, std::size_t method);

/// One line a scenario and method other than the baseline: what it covers at 0.05 m and how far it
/// flies against the baseline, with intervals, p values and what they allow to say.
std::vector<std::string> answers(const Comparison& comparison);

/// A row per scenario, metric and method, then the ranks over all scenarios if there are several.
/// The answers are the first notes; the others say what the columns are.
TextTable comparison_table(const Comparison& comparison);

}  // namespace gnbv
