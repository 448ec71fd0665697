// Is A better than B here? Methods over structures, or over the seeds of one, with intervals and
// paired tests.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/compare/mission_row.hpp"
#include "bench/compare/statistics.hpp"
#include "bench/compare/text_table.hpp"

namespace gnbv {

// ---- run_metrics.cpp: the figures of a mission that methods are compared by

struct RunMetric {
  std::string name;  // with the unit of the value
  std::string key;   // of MissionRow's figures
  double factor = 1.0;
  bool higher_is_better = true;
  int decimals = 1;
  /// Whether a method can be better by it. Nobody is for ending early, nor for reducing entropy.
  bool is_judged = true;
  /// Of an effort the figure that says what a mission which used up its budget has spent.
  std::string limit_key = {};
  /// Of the whole cloud, also of views beyond the budget: not judged where a mission has some.
  bool is_of_all_views = false;

  std::optional<double> value(const MissionRow& mission) const;
  bool is_effort() const { return !limit_key.empty(); }
};

constexpr std::string_view kCoverageMetric = "coverage at 0.05 m (%)";
constexpr std::string_view kDistanceMetric = "distance (m)";

/// In the order of tables: coverage at 0.05 m first, all within the budget of views, then the
/// others that every mission has, the efforts to reach kReachShares of the ceiling, and the
/// coverage at each size that any of the missions has beside the paper's, ascending.
std::vector<RunMetric> metrics_of(std::span<const MissionRow> missions);

// ---- comparison.cpp and comparison_text.cpp

/// What the pairs say about a difference.
enum class Verdict {
  told,             // of a figure that is not judged, or of one structure among several
  untested,         // one pair
  equal,            // none of several pairs makes a difference
  too_few,          // so few differ that no p of the test could be below 5 %, after Holm
  not_significant,  // the test could reject and does not
  significant       // the signed-rank test rejects at 5 %, after Holm
};

/// What the seeds of a scenario move, as far as its missions show it.
enum class Varies { start, start_and_noise, draws, nothing };

/// A method against the baseline, over the seeds or structures that both have. Where a run did not
/// reach what the metric asks for, it is worse than any that did, and as good as another that did
/// not; in means it counts as the budget, the largest of the methods'.
struct Contrast {
  double baseline_mean = 0.0;
  MeanEstimate difference = {};  // method - baseline, over all pairs
  SignedRankTest test = {};      // two-sided, over all pairs
  std::size_t family = 1;        // methods that Holm adjusts for
  double p_holm = 1.0;           // adjusted over the methods of this scenario and metric
  Verdict verdict = Verdict::told;
};

/// The least p that a contrast could have had, after Holm's first step; above 5 % its test cannot
/// reject, whatever the values.
double least_p_holm(const Contrast& contrast);

/// A method by a metric in a scenario, over its seeds; or in all structures, each of them the mean
/// of its runs (of an effort, for median, ranks and test: the median). Seeds that flew one and the
/// same mission (by result_sha256) are one observation, here and in a contrast.
struct MethodFigure {
  std::size_t scenario = 0;  // indices into Comparison's lists
  std::size_t metric = 0;
  std::size_t method = 0;
  std::size_t reached = 0;                // of those below: an effort within the budget
  MeanEstimate estimate = {};             // a run that did not get there counts as the budget
  std::optional<double> median = {};      // of efforts: not reached is the largest, and no number
  std::optional<double> rank = {};        // mean over the pairs that all methods have; 1 is best
  std::optional<Contrast> contrast = {};  // none for the baseline
};

struct Comparison {
  std::vector<RunMetric> metrics;  // metrics_of() all missions
  /// Then, of several structures, the block over all of them: "all 6 structures".
  std::vector<std::string> scenarios;
  std::size_t structures = 0;             // different ones: the pairs, if there are several
  std::vector<std::size_t> area_samples;  // by scenario, of the reference: what coverage counts
  std::vector<Varies> varies;             // by scenario
  std::vector<bool> is_over_budget;  // by scenario: some missions took more views than the budget
  std::vector<std::string> methods;
  std::size_t baseline = 0;
  std::vector<Budgets> budgets;       // by scenario
  std::vector<MethodFigure> figures;  // by scenario, metric, method; without what nobody measured
  /// A method, and the first one before it that flew the very same missions wherever both flew (by
  /// result_sha256): what sets the two apart has no effect.
  std::vector<std::array<std::size_t, 2>> same_missions = {};

  /// Whether this is the block over all structures.
  bool is_of_all(std::size_t scenario) const { return scenario == area_samples.size(); }
  /// Whether methods are tested there: over structures if there are several, else over seeds.
  bool is_tested(std::size_t scenario) const { return is_of_all(scenario) == (structures > 1); }
  /// Whether methods can be better there by the metric.
  bool is_judged(std::size_t scenario, std::size_t metric) const {
    return metrics[metric].is_judged &&
           !(metrics[metric].is_of_all_views && is_over_budget[scenario]);
  }
};

/// Scenarios and methods in the order of their first runs; no figure depends on that order.
/// Scenarios of one structure (MissionRow::structure_id(); without one the scenario) are one pair.
/// Requires a mission of the baseline, and no two of one scenario, method and seed.
Comparison compare(std::span<const MissionRow> missions, const std::string& baseline);

/// The figure of a method, if it has one.
const MethodFigure* find_figure(const Comparison& comparison, std::size_t scenario,
                                std::string_view metric, std::size_t method);

/// One line a method other than the baseline, where methods are tested: what it covers at 0.05 m
/// and how far it flies against the baseline, with intervals, and what the test of the first says.
std::vector<std::string> answers(const Comparison& comparison);

/// A row per scenario, metric and method, then those over all structures if there are several. The
/// answers are the first notes; the others say what the columns are.
TextTable comparison_table(const Comparison& comparison);

}  // namespace gnbv
