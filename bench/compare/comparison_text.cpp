// answers() and comparison_table() of comparison.hpp: a comparison in words and as a table.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <set>

#include "bench/compare/comparison.hpp"
#include "bench/compare/paper_figures.hpp"
#include "bench/score/surface_reference.hpp"
#include "sim/core/text.hpp"

namespace gnbv {
namespace {

using Row = std::vector<TableCell>;

/// p values below what anybody reads are not spelt out.
std::string p_text(double p) { return p < 0.001 ? "< 0.001" : fmt::format("{:.3f}", p); }

/// What the pairs of a scenario are.
std::string pairs_of(const Comparison& comparison, std::size_t scenario) {
  return comparison.is_of_all(scenario) ? "structure" : "seed";
}

std::string verdict_words(const Contrast& contrast, const std::string& pair) {
  switch (contrast.verdict) {
    case Verdict::told:
      return "-";
    case Verdict::untested:
      return fmt::format("one {}: no test", pair);
    case Verdict::equal:
      return "equal";
    case Verdict::too_few:
      return fmt::format("too few {}s{}", pair,
                         contrast.test.n < contrast.difference.n ? " that differ" : "");
    case Verdict::significant:
      return "significant";
    case Verdict::not_significant:
      break;
  }
  return "not significant";
}

/// " (95 % CI 0.7 to 2.1, p = 0.062, n = 5 seeds: ...)", of the size of the difference.
std::string evidence(const Contrast& contrast, const std::string& unit, const std::string& pair) {
  const MeanEstimate& d = contrast.difference;
  const bool is_told = contrast.verdict == Verdict::told;
  if (!d.half_width) return is_told ? "" : " (" + verdict_words(contrast, pair) + ")";
  const double size = std::abs(d.mean);
  std::string words = fmt::format(" (95 % CI {} to {}{}", grouped(size - *d.half_width, 1),
                                  grouped(size + *d.half_width, 1), unit);
  if (is_told) return words + ")";
  return words + fmt::format(", p = {}{}, n = {} {}s: {})", p_text(contrast.p_holm),
                             contrast.p_holm != contrast.test.p ? " after Holm" : "", d.n, pair,
                             verdict_words(contrast, pair));
}

std::string coverage_answer(const Contrast& contrast, const std::string& baseline,
                            const std::string& pair) {
  if (contrast.test.n == 0) {
    return fmt::format("covers as much as {}{}", baseline,
                       contrast.verdict == Verdict::equal ? "" : evidence(contrast, "", pair));
  }
  const double points = contrast.difference.mean;
  return fmt::format("covers {} points {} than {} at 0.05 m{}", grouped(std::abs(points), 1),
                     points < 0.0 ? "less" : "more", baseline, evidence(contrast, "", pair));
}

std::string distance_answer(const Contrast& contrast) {
  if (contrast.test.n == 0) return "in as many metres";
  const double metres = contrast.difference.mean;
  const std::string share =
      contrast.baseline_mean > 0.0
          ? fmt::format(", {:.0f} %", 100.0 * std::abs(metres) / contrast.baseline_mean)
          : "";
  return fmt::format("in {} m {}{}{}", grouped(std::abs(metres), 1), metres < 0.0 ? "less" : "more",
                     share, evidence(contrast, " m", ""));
}

std::string verdict_cell(const Contrast& contrast, bool higher_is_better, const std::string& pair) {
  if (contrast.verdict != Verdict::significant) return verdict_words(contrast, pair);
  return contrast.test.is_above() == higher_is_better ? "better" : "worse";
}

/// "8", or "5 of 8" where the others did not get there.
TableCell count_cell(std::size_t n, std::size_t runs) {
  return {n == runs ? std::to_string(n) : fmt::format("{} of {}", n, runs),
          {static_cast<double>(n), static_cast<double>(runs)}};
}

TableCell number_cell(const std::optional<double>& number, int decimals) {
  return number ? TableCell{grouped(*number, decimals), {number}} : TableCell{};
}

/// Difference, p, Holm and verdict.
Row contrast_cells(const Comparison& comparison, const MethodFigure& figure) {
  const std::string pair = pairs_of(comparison, figure.scenario);
  if (!figure.contrast) {
    const bool is_baseline = figure.method == comparison.baseline;
    return {{}, {}, {}, {is_baseline ? "baseline" : "no common " + pair}};
  }
  const RunMetric& metric = comparison.metrics[figure.metric];
  const Contrast& c = *figure.contrast;
  Row row = {estimate_cell(c.difference, metric.decimals), {}, {}, {}};
  if (c.verdict != Verdict::told && c.verdict != Verdict::untested) {
    row[1] = {p_text(c.test.p), {c.test.p, static_cast<double>(c.test.n), c.test.w_plus}};
    row[2] = {p_text(c.p_holm), {c.p_holm}};
  }
  row[3].text = verdict_cell(c, metric.higher_is_better, pair);
  return row;
}

Row figure_row(const Comparison& comparison, const MethodFigure& figure) {
  const RunMetric& metric = comparison.metrics[figure.metric];
  Row row = {{comparison.scenarios[figure.scenario]},
             {metric.name},
             {comparison.methods[figure.method]},
             count_cell(figure.reached, figure.estimate.n),
             estimate_cell(figure.estimate, metric.decimals),
             number_cell(figure.median, metric.decimals),
             number_cell(figure.rank, 2)};
  const Row cells = contrast_cells(comparison, figure);
  row.insert(row.end(), cells.begin(), cells.end());
  return row;
}

/// Whether any method got to this metric in this scenario, or in any for the block over all.
bool is_reached(const Comparison& comparison, const MethodFigure& figure) {
  return std::ranges::any_of(comparison.figures, [&](const MethodFigure& other) {
    const bool is_there =
        other.scenario == figure.scenario || comparison.is_of_all(figure.scenario);
    return is_there && other.metric == figure.metric && other.reached > 0;
  });
}

/// Whether shares of it, and efforts to reach them, are known of any run.
bool has_ceiling(const Comparison& comparison) {
  return std::ranges::any_of(comparison.figures, [&](const MethodFigure& figure) {
    return comparison.metrics[figure.metric].name.starts_with("share of ceiling");
  });
}

/// What the efforts to reach a share of the ceiling are, and which of them nobody did.
void add_effort_notes(std::vector<std::string>& notes, const Comparison& comparison) {
  if (!has_ceiling(comparison)) return;
  std::map<std::size_t, std::set<std::string>> missed;  // by scenario
  constexpr std::string_view kViews = "views to ";      // and so for metres and seconds
  for (const MethodFigure& figure : comparison.figures) {
    const std::string& metric = comparison.metrics[figure.metric].name;
    if (!metric.starts_with(kViews) || comparison.is_of_all(figure.scenario)) continue;
    if (!is_reached(comparison, figure))
      missed[figure.scenario].insert(metric.substr(kViews.size()));
  }
  notes.emplace_back(
      "to N % of ceiling: until the cloud first covered so much at 0.05 m of what it can hold, "
      "within the budget; n: how many runs got there; median: of all, not to get there being the "
      "largest; mean and difference: of all, where a run that did not counts as the budget, "
      "from take-off as the largest of the methods'; rank, p and verdict: of all, where it is "
      "worse than any that did; from take-off: since the mission began in the air, with its "
      "profile; on one battery: with the way home (docs/how/scores.md)");
  for (const auto& [scenario, names] : missed) {
    notes.push_back(fmt::format("{}: no run got to {}", comparison.scenarios[scenario],
                                fmt::join(names, ", ")));
  }
}

/// How many it takes, once for each number of methods.
void add_power_notes(std::vector<std::string>& notes, const Comparison& comparison) {
  std::set<std::size_t> said;
  for (const MethodFigure& figure : comparison.figures) {
    if (!figure.contrast || figure.contrast->verdict != Verdict::too_few) continue;
    Contrast c = *figure.contrast;
    if (!said.insert(c.family).second) continue;
    for (c.test.n = 1; least_p_holm(c) > 0.05; ++c.test.n) continue;
    const std::size_t enough = c.test.n--;
    notes.push_back(fmt::format(
        "too few: the exact signed-rank test cannot reject at 5 % with fewer than {} {}s that "
        "differ; {} have p = {:.4g} at best{}",
        enough, pairs_of(comparison, figure.scenario), c.test.n, least_p_holm(c),
        c.family > 1 ? fmt::format(", after Holm over {} methods", c.family) : ""));
  }
}

/// Over what it is tested, and what a seed moves.
void add_pair_notes(std::vector<std::string>& notes, const Comparison& comparison) {
  if (comparison.structures > 1) {
    notes.push_back(fmt::format(
        "{}: the pairs are structures, each the mean of its runs (of efforts, for median, rank, p "
        "and verdict, their median); rows of one scenario describe it: its pairs are seeds",
        comparison.scenarios.back()));
  } else {
    notes.emplace_back(
        "the pairs are the seeds of one structure: p and verdict say nothing of others");
  }
  constexpr std::array kVaries = {
      // by Varies
      "the start is what varies over the seeds, and what a planner draws by them: sensors and "
      "poses are exact",
      "start and noise are what varies over the seeds",
      "what a planner draws by them is all that varies over the seeds: start, sensors and poses "
      "are the same, and missions that are the very same count once",
      "nothing varies over the seeds (no start.jitter_m, exact sensors): each method flew one and "
      "the same mission, which counts once"};
  std::array<std::vector<std::string>, kVaries.size()> names;
  for (std::size_t s = 0; s < comparison.varies.size(); ++s) {
    names[static_cast<std::size_t>(comparison.varies[s])].push_back(comparison.scenarios[s]);
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i].empty()) continue;
    notes.push_back(fmt::format("{}: {}", fmt::join(names[i], ", "), kVaries[i]));
  }
}

std::vector<std::string> notes(const Comparison& comparison) {
  const std::vector<std::size_t>& samples = comparison.area_samples;
  const bool is_one_reference =
      std::ranges::adjacent_find(samples, std::not_equal_to()) == samples.end();
  std::vector<std::string> all = answers(comparison);
  for (const auto& [later, earlier] : comparison.same_missions) {
    all.push_back(fmt::format("{} flew the very missions of {}: what sets them apart has no effect",
                              comparison.methods[later], comparison.methods[earlier]));
  }
  add_pair_notes(all, comparison);
  add_power_notes(all, comparison);
  if (std::ranges::any_of(comparison.figures, [](const MethodFigure& figure) {
        return figure.contrast && figure.contrast->test.n > kMostExact;
      })) {
    all.push_back(fmt::format(
        "p of more than {} pairs that differ is the test's normal approximation", kMostExact));
  }
  if (auto note = formulas_note(comparison.methods)) all.push_back(std::move(*note));
  all.push_back(fmt::format(
      "mean: ± its 95 % interval over the pairs (Student's t); rank: mean over the pairs that all "
      "methods have, 1 is best; difference: against {} over the pairs that both have, ± its 95 % "
      "interval (Student's t, not adjusted for several methods); p: two-sided exact signed-rank "
      "test (Wilcoxon); Holm: over the methods of a metric, not over metrics",
      comparison.methods[comparison.baseline]));
  all.emplace_back(
      "distance, flight time, views, density and entropy reduction are told, not judged: a mission "
      "that ends early has little of them for that reason alone");
  for (std::size_t s = 0; s < samples.size(); ++s) {
    if (!comparison.is_over_budget[s]) continue;
    all.push_back(fmt::format(
        "{}: some missions took more views than the budget; F and Chamfer distance are of all of "
        "them, and so told, not judged",
        comparison.scenarios[s]));
  }
  for (std::size_t s = 0; s < samples.size(); ++s) {
    const std::string where = is_one_reference ? "" : comparison.scenarios[s] + ": ";
    all.push_back(fmt::format("{}coverage of voxels {}", where, reference_words(samples[s])));
    if (is_one_reference) break;
  }
  all.push_back(fmt::format(
      "{}distance in straight lines between views, profile apart; flight time of the whole mission",
      has_ceiling(comparison) ? "share of ceiling: coverage divided by the most that any planner "
                                "could cover from allowed positions with exact sensors; "
                              : ""));
  add_effort_notes(all, comparison);
  for (std::size_t s = 0; s < comparison.budgets.size(); ++s) {
    const Budgets& b = comparison.budgets[s];
    if (b[0] <= 0.0) continue;
    all.push_back(fmt::format(
        "{}: the budget is {:.0f} views, {:g} m from the first view on, {:g} s from the "
        "end of the profile on; coverage, views and distance are within the views",
        comparison.scenarios[s], b[0], b[1], b[2]));
  }
  return all;
}

}  // namespace

std::vector<std::string> answers(const Comparison& comparison) {
  std::vector<std::string> lines;
  const std::string& baseline = comparison.methods[comparison.baseline];
  for (std::size_t s = 0; s < comparison.scenarios.size(); ++s) {
    if (!comparison.is_tested(s)) continue;
    const std::string pair = pairs_of(comparison, s);
    for (std::size_t m = 0; m < comparison.methods.size(); ++m) {
      if (m == comparison.baseline) continue;
      const MethodFigure* const coverage = find_figure(comparison, s, kCoverageMetric, m);
      const MethodFigure* const distance = find_figure(comparison, s, kDistanceMetric, m);
      const std::string who = fmt::format("{}: {}", comparison.scenarios[s], comparison.methods[m]);
      if (coverage == nullptr || !coverage->contrast) {
        lines.push_back(fmt::format("{} has no {} in common with {}", who, pair, baseline));
        continue;
      }
      lines.push_back(
          fmt::format("{} {}", who, coverage_answer(*coverage->contrast, baseline, pair)));
      if (distance != nullptr && distance->contrast) {
        lines.back() += " " + distance_answer(*distance->contrast);
      }
    }
  }
  return lines;
}

TextTable comparison_table(const Comparison& comparison) {
  using enum ColumnKind;
  TextTable table;
  std::vector<std::string> others = comparison.methods;
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(comparison.baseline));
  table.title = fmt::format("{} against {}", fmt::join(others, ", "),
                            comparison.methods[comparison.baseline]);
  table.columns = {{"Scenario", "scenario"},   {"Metric", "metric"},
                   {"Method", "method"},       {"n", "n", counted},
                   {"Mean", "mean", estimate}, {"Median", "median", number},
                   {"Rank", "rank", number},   {"Difference", "difference", estimate},
                   {"p", "p", tested},         {"Holm", "p_holm", number},
                   {"Verdict", "verdict"}};
  for (const MethodFigure& figure : comparison.figures) {
    if (is_reached(comparison, figure)) table.rows.push_back(figure_row(comparison, figure));
  }
  table.notes = notes(comparison);
  return table;
}

}  // namespace gnbv
