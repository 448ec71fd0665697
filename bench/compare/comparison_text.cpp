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
#include "bench/score/surface_reference.hpp"
#include "sim/core/text.hpp"

namespace gnbv {
namespace {

using Row = std::vector<TableCell>;

/// p values below what anybody reads are not spelt out.
std::string p_text(double p) { return p < 0.001 ? "< 0.001" : fmt::format("{:.3f}", p); }

std::string verdict_words(const Contrast& contrast) {
  switch (contrast.verdict) {
    case Verdict::significant:
      return "significant";
    case Verdict::interval_only:
      return fmt::format("the interval excludes 0, but {} seeds{} are too few for the test",
                         contrast.differing,
                         contrast.differing < contrast.pairs ? " with a difference" : "");
    case Verdict::untested:
      return "one seed: no test";
    case Verdict::equal:
    case Verdict::not_significant:
      break;
  }
  return "not significant";
}

/// "95 % CI 0.7 to 2.1, p = 0.062, n = 5: ...", of the size of the difference.
std::string evidence(const Contrast& contrast, const std::string& unit) {
  const MeanEstimate& d = contrast.difference;
  if (!d.half_width) return verdict_words(contrast);
  const double size = std::abs(d.mean);
  const bool is_adjusted = contrast.p_holm != contrast.p;
  return fmt::format("95 % CI {} to {}{}, p = {}{}, n = {}: {}", grouped(size - *d.half_width, 1),
                     grouped(size + *d.half_width, 1), unit, p_text(contrast.p_holm),
                     is_adjusted ? " after Holm" : "", contrast.pairs, verdict_words(contrast));
}

/// Why nothing is said of a difference, behind words of it; nothing where something is.
std::optional<std::string> as_much(const Contrast& contrast, const std::string& words) {
  if (contrast.verdict == Verdict::equal) return words;
  if (contrast.verdict != Verdict::untested || contrast.difference.mean != 0.0) return std::nullopt;
  return fmt::format("{} ({})", words, verdict_words(contrast));
}

std::string coverage_answer(const Contrast& contrast, const std::string& baseline) {
  if (auto same = as_much(contrast, "covers as much as " + baseline)) return *same;
  const double points = contrast.difference.mean;
  return fmt::format("covers {} points {} than {} at 0.05 m ({})", grouped(std::abs(points), 1),
                     points < 0.0 ? "less" : "more", baseline, evidence(contrast, ""));
}

std::string distance_answer(const Contrast& contrast) {
  if (auto same = as_much(contrast, "in as many metres")) return *same;
  const double metres = contrast.difference.mean;
  const std::string share =
      contrast.baseline_mean > 0.0
          ? fmt::format(", {:.0f} %", 100.0 * std::abs(metres) / contrast.baseline_mean)
          : "";
  return fmt::format("in {} m {}{} ({})", grouped(std::abs(metres), 1),
                     metres < 0.0 ? "less" : "more", share, evidence(contrast, " m"));
}

std::string verdict_cell(const Contrast& contrast, bool higher_is_better) {
  const bool is_above =
      contrast.verdict == Verdict::significant ? contrast.is_above : contrast.difference.mean > 0.0;
  const bool is_better = is_above == higher_is_better;
  switch (contrast.verdict) {
    case Verdict::significant:
      return is_better ? "better" : "worse";
    case Verdict::interval_only:
      return is_better ? "better, by interval only" : "worse, by interval only";
    case Verdict::untested:
      return "one seed";
    case Verdict::equal:
      return "equal";
    case Verdict::not_significant:
      break;
  }
  return "not significant";
}

/// "8", or "5 of 8" where the others did not get there.
TableCell count_cell(std::size_t n, std::size_t runs) {
  return {n == runs ? std::to_string(n) : fmt::format("{} of {}", n, runs),
          {static_cast<double>(n), static_cast<double>(runs)}};
}

TableCell rank_cell(const std::optional<double>& rank) {
  return rank ? TableCell{fmt::format("{:.2f}", *rank), {rank}} : TableCell{};
}

TableCell mean_cell(const MeanEstimate& estimate, int decimals) {
  return estimate.n == 0 ? TableCell{} : estimate_cell(estimate, decimals);
}

/// Difference, p, Holm and verdict.
Row contrast_cells(const Comparison& comparison, const MethodFigure& figure) {
  if (!figure.contrast) {
    const bool is_baseline = figure.method == comparison.baseline;
    return {{}, {}, {}, {is_baseline ? "baseline" : "no common seed"}};
  }
  const RunMetric& metric = comparison.metrics[figure.metric];
  const Contrast& c = *figure.contrast;
  const auto p_cell = [&](double p) {
    return c.pairs < 2 ? TableCell{} : TableCell{p_text(p), {p}};
  };
  TableCell difference = mean_cell(c.difference, metric.decimals);
  if (c.difference.n > 0 && c.difference.n < c.pairs) {
    difference.text += fmt::format(" (n = {})", c.difference.n);
  }
  return {difference, p_cell(c.p), p_cell(c.p_holm), {verdict_cell(c, metric.higher_is_better)}};
}

Row figure_row(const Comparison& comparison, const MethodFigure& figure) {
  const RunMetric& metric = comparison.metrics[figure.metric];
  Row row = {
      {comparison.scenarios[figure.scenario]},     {metric.name},
      {comparison.methods[figure.method]},         count_cell(figure.estimate.n, figure.runs),
      mean_cell(figure.estimate, metric.decimals), rank_cell(figure.rank)};
  const Row cells = contrast_cells(comparison, figure);
  row.insert(row.end(), cells.begin(), cells.end());
  return row;
}

/// Whether any run of any method has a finite value of this metric in this scenario.
bool is_reached(const Comparison& comparison, const MethodFigure& figure) {
  return std::any_of(comparison.figures.begin(), comparison.figures.end(),
                     [&](const MethodFigure& other) {
                       return other.scenario == figure.scenario && other.metric == figure.metric &&
                              other.estimate.n > 0;
                     });
}

/// Whether shares of it, and efforts to reach them, are known of any run.
bool has_ceiling(const Comparison& comparison) {
  return std::any_of(
      comparison.figures.begin(), comparison.figures.end(), [&](const MethodFigure& figure) {
        return comparison.metrics[figure.metric].name.starts_with("share of ceiling");
      });
}

/// What the efforts to reach a share of the ceiling are, and which of them nobody did.
void add_effort_notes(std::vector<std::string>& notes, const Comparison& comparison) {
  if (!has_ceiling(comparison)) return;
  std::map<std::size_t, std::vector<std::string>> missed;  // by scenario
  for (const MethodFigure& figure : comparison.figures) {
    const std::string& metric = comparison.metrics[figure.metric].name;
    if (!metric.starts_with("views to ") || is_reached(comparison, figure)) continue;
    std::vector<std::string>& names = missed[figure.scenario];
    const std::string share = metric.substr(std::string_view("views to ").size());
    if (std::find(names.begin(), names.end(), share) == names.end()) names.push_back(share);
  }
  notes.emplace_back(
      "to N % of ceiling: until the cloud first covered so much at 0.05 m of what it can hold; n: "
      "how many runs got there, the mean is over these; difference: over the seeds where both "
      "methods did; rank, p and verdict: over all, where a run that did not get there is worse "
      "than "
      "any that did. Distance and flight time of a mission that ended early are small for that "
      "reason alone: these efforts are not");
  for (const auto& [scenario, names] : missed) {
    notes.push_back(fmt::format("{}: no run got to {}", comparison.scenarios[scenario],
                                fmt::join(names, ", ")));
  }
}

/// What so few seeds cannot say, once for all contrasts alike.
void add_power_notes(std::vector<std::string>& notes, const Comparison& comparison) {
  std::set<std::array<std::size_t, 3>> said;
  for (const MethodFigure& figure : comparison.figures) {
    if (!figure.contrast || figure.contrast->verdict != Verdict::interval_only) continue;
    Contrast c = *figure.contrast;
    if (!said.insert({c.pairs, c.differing, c.family}).second) continue;
    const double least = least_wilcoxon_p(c.differing);
    const double least_after_holm = std::min(1.0, least_p_holm(c));
    const std::size_t differing = c.differing;
    while (least_p_holm(c) > 0.05) ++c.differing;
    notes.push_back(fmt::format(
        "by interval only at n = {}{}: no p of the signed-rank test can be below {:.4g}{} there, "
        "so it cannot reject at 5 %; {} that differ could. \"By interval only\" means that "
        "Student's interval excludes 0: an indication that rests on differences being about "
        "normal, not a test passed{}",
        c.pairs,
        differing < c.pairs ? fmt::format(", {} of them with a difference", differing) : "", least,
        c.family > 1
            ? fmt::format(", {:.4g} after Holm over {} methods", least_after_holm, c.family)
            : "",
        c.differing, c.family > 1 ? "; the intervals are not adjusted for several methods" : ""));
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
  add_power_notes(all, comparison);
  all.push_back(fmt::format(
      "mean: over the seeds, ± its 95 % interval (Student's t); rank: mean over the seeds that all "
      "methods have, 1 is best; difference: against {} over the seeds that both have, ± its 95 % "
      "interval (Student's t); p: two-sided signed-rank test (Wilcoxon); Holm: over "
      "the methods of a scenario and metric, not over metrics",
      comparison.methods[comparison.baseline]));
  for (std::size_t s = 0; s < comparison.scenarios.size(); ++s) {
    const std::string where = is_one_reference ? "" : comparison.scenarios[s] + ": ";
    all.push_back(
        fmt::format("{}coverage of voxels {}", where, reference_words(comparison.area_samples[s])));
    if (is_one_reference) break;
  }
  all.push_back(fmt::format(
      "{}distance in straight lines between views, profile apart; flight time of the whole mission",
      has_ceiling(comparison) ? "share of ceiling: over what the leaf filter lets through of all "
                                "that legal viewpoints see; "
                              : ""));
  add_effort_notes(all, comparison);
  for (std::size_t s = 0; s < comparison.scenarios.size(); ++s) {
    const std::array<double, 3>& b = comparison.budgets[s];
    if (b[0] <= 0.0) continue;
    all.push_back(
        fmt::format("{}: AUC is mean coverage at 0.05 m up to the longest run's {:.0f} views, "
                    "{:.0f} m, {:.0f} s",
                    comparison.scenarios[s], b[0], b[1], b[2]));
  }
  return all;
}

}  // namespace

std::vector<std::string> answers(const Comparison& comparison) {
  std::vector<std::string> lines;
  const std::string& baseline = comparison.methods[comparison.baseline];
  for (std::size_t s = 0; s < comparison.scenarios.size(); ++s) {
    for (std::size_t m = 0; m < comparison.methods.size(); ++m) {
      if (m == comparison.baseline) continue;
      const MethodFigure* const coverage = find_figure(comparison, s, kCoverageMetric, m);
      const MethodFigure* const distance = find_figure(comparison, s, kDistanceMetric, m);
      const std::string who = fmt::format("{}: {}", comparison.scenarios[s], comparison.methods[m]);
      if (coverage == nullptr || !coverage->contrast || !distance->contrast) {
        lines.push_back(fmt::format("{} has no seed in common with {}", who, baseline));
        continue;
      }
      lines.push_back(fmt::format("{} {} {}", who, coverage_answer(*coverage->contrast, baseline),
                                  distance_answer(*distance->contrast)));
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
  table.columns = {{"Scenario", "scenario"},
                   {"Metric", "metric"},
                   {"Method", "method"},
                   {"n", "n", counted},
                   {"Mean", "mean", estimate},
                   {"Rank", "rank", number},
                   {"Difference", "difference", estimate},
                   {"p", "p", number},
                   {"Holm", "p_holm", number},
                   {"Verdict", "verdict"}};
  for (const MethodFigure& figure : comparison.figures) {
    if (is_reached(comparison, figure)) table.rows.push_back(figure_row(comparison, figure));
  }
  if (comparison.scenarios.size() > 1) {
    for (const auto& [metric, method, blocks, rank] : comparison.ranks) {
      table.rows.push_back({{"all scenarios"},
                            {comparison.metrics[metric].name},
                            {comparison.methods[method]},
                            count_cell(blocks, blocks),
                            {},
                            rank_cell(rank)});
      table.rows.back().resize(table.columns.size());
    }
  }
  table.notes = notes(comparison);
  return table;
}

}  // namespace gnbv
