#include "bench/compare/comparison_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "sim/core/text.hpp"

namespace gnbv {
namespace {

/// p values below what anybody reads are not spelt out.
std::string p_text(double p) { return p < 0.001 ? "< 0.001" : fmt::format("{:.3f}", p); }

std::string number(double value, int decimals) { return grouped(value, decimals); }

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
std::string evidence(const Contrast& contrast, int decimals, const std::string& unit) {
  const MeanEstimate& d = contrast.difference;
  if (!d.half_width) return verdict_words(contrast);
  const double size = std::abs(d.mean);
  const bool is_adjusted = contrast.p_holm != contrast.p;
  return fmt::format("95 % CI {} to {}{}, p = {}{}, n = {}: {}",
                     number(size - *d.half_width, decimals), number(size + *d.half_width, decimals),
                     unit, p_text(contrast.p_holm), is_adjusted ? " after Holm" : "",
                     contrast.pairs, verdict_words(contrast));
}

std::string coverage_answer(const Contrast& contrast, const std::string& baseline) {
  if (contrast.verdict == Verdict::equal) return fmt::format("covers as much as {}", baseline);
  if (contrast.verdict == Verdict::untested && contrast.difference.mean == 0.0) {
    return fmt::format("covers as much as {} ({})", baseline, verdict_words(contrast));
  }
  const double points = contrast.difference.mean;
  return fmt::format("covers {} points {} than {} at 0.05 m ({})", number(std::abs(points), 1),
                     points < 0.0 ? "less" : "more", baseline, evidence(contrast, 1, ""));
}

std::string distance_answer(const Contrast& contrast) {
  if (contrast.verdict == Verdict::equal) return "in as many metres";
  if (contrast.verdict == Verdict::untested && contrast.difference.mean == 0.0) {
    return fmt::format("in as many metres ({})", verdict_words(contrast));
  }
  const double metres = contrast.difference.mean;
  const std::string share =
      contrast.baseline_mean > 0.0
          ? fmt::format(", {:.0f} %", 100.0 * std::abs(metres) / contrast.baseline_mean)
          : "";
  return fmt::format("in {} m {}{} ({})", number(std::abs(metres), 1),
                     metres < 0.0 ? "less" : "more", share, evidence(contrast, 1, " m"));
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

using Row = std::vector<TableCell>;

TableCell nothing() { return {.text = "-"}; }

TableCell estimate_cell(const MeanEstimate& e, int decimals) {
  if (e.n == 0) return nothing();
  std::string text = number(e.mean, decimals);
  if (e.half_width) text += " ±" + number(*e.half_width, decimals);
  return {.text = text, .values = {e.mean, e.half_width}};
}

void add_contrast(Row& row, const Comparison& comparison, const MethodFigure& figure) {
  if (!figure.contrast) {
    row.insert(row.end(), 3, nothing());
    row.push_back({.text = figure.method == comparison.baseline ? "baseline" : "no common seed"});
    return;
  }
  const RunMetric& metric = comparison.metrics[figure.metric];
  const Contrast& c = *figure.contrast;
  row.push_back(estimate_cell(c.difference, metric.decimals));
  if (c.difference.n > 0 && c.difference.n < c.pairs) {
    row.back().text += fmt::format(" (n = {})", c.difference.n);
  }
  if (c.pairs < 2) {
    row.insert(row.end(), 2, nothing());
  } else {
    row.push_back({.text = p_text(c.p), .values = {c.p, std::nullopt}});
    row.push_back({.text = p_text(c.p_holm), .values = {c.p_holm, std::nullopt}});
  }
  row.push_back({.text = verdict_cell(c, metric.higher_is_better)});
}

/// "8", or "5 of 8" where the others did not get there.
TableCell count_cell(std::size_t n, std::size_t runs) {
  return {.text = n == runs ? std::to_string(n) : fmt::format("{} of {}", n, runs),
          .values = {static_cast<double>(n), static_cast<double>(runs)}};
}

Row figure_row(const Comparison& comparison, const MethodFigure& figure) {
  const RunMetric& metric = comparison.metrics[figure.metric];
  Row row = {
      {.text = comparison.scenarios[figure.scenario]},
      {.text = std::string(metric.name)},
      {.text = comparison.methods[figure.method]},
      count_cell(figure.estimate.n, figure.runs),
      estimate_cell(figure.estimate, metric.decimals),
      figure.rank ? TableCell{fmt::format("{:.2f}", *figure.rank), {figure.rank, {}}} : nothing()};
  add_contrast(row, comparison, figure);
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

bool has_ceiling(const Comparison& comparison) {
  return std::any_of(comparison.figures.begin(), comparison.figures.end(),
                     [&](const MethodFigure& figure) {
                       const RunMetric& metric = comparison.metrics[figure.metric];
                       return metric.name.starts_with("share of ceiling") && figure.estimate.n > 0;
                     });
}

/// What the efforts to reach a share of the ceiling are, and which of them nobody did.
void add_effort_notes(std::vector<std::string>& notes, const Comparison& comparison) {
  std::map<std::size_t, std::vector<std::string>> missed;  // by scenario
  bool has_efforts = false;
  for (const MethodFigure& figure : comparison.figures) {
    const RunMetric& metric = comparison.metrics[figure.metric];
    has_efforts = has_efforts || metric.may_be_missed;
    if (!metric.name.starts_with("views to ") || is_reached(comparison, figure)) continue;
    std::vector<std::string>& names = missed[figure.scenario];
    const std::string share = metric.name.substr(std::string_view("views to ").size());
    if (std::find(names.begin(), names.end(), share) == names.end()) names.push_back(share);
  }
  if (!has_efforts) return;
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

Row rank_row(const Comparison& comparison, const OverallRank& rank) {
  return {{.text = "all scenarios"},
          {.text = std::string(comparison.metrics[rank.metric].name)},
          {.text = comparison.methods[rank.method]},
          count_cell(rank.blocks, rank.blocks),
          nothing(),
          {fmt::format("{:.2f}", rank.rank), {rank.rank, std::nullopt}},
          nothing(),
          nothing(),
          nothing(),
          {.text = "-"}};
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
  all.push_back(fmt::format(
      "coverage of voxels with visible surface of a tenth of their face; {}distance in straight "
      "lines between views, profile apart; flight time of the whole mission",
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
  table.columns = {{"Scenario", "scenario", text},
                   {"Metric", "metric", text},
                   {"Method", "method", text},
                   {"n", "n", counted},
                   {"Mean", "mean", estimate},
                   {"Rank", "rank", number},
                   {"Difference", "difference", estimate},
                   {"p", "p", number},
                   {"Holm", "p_holm", number},
                   {"Verdict", "verdict", text}};
  for (const MethodFigure& figure : comparison.figures) {
    if (is_reached(comparison, figure)) table.rows.push_back(figure_row(comparison, figure));
  }
  if (comparison.scenarios.size() > 1) {
    for (const OverallRank& rank : comparison.ranks) {
      table.rows.push_back(rank_row(comparison, rank));
    }
  }
  table.notes = notes(comparison);
  return table;
}

}  // namespace gnbv
