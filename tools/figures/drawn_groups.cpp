// Groups of runs as series, and the levels that their coverage is compared with.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/compare/paper_figures.hpp"
#include "scenarios/load.hpp"
#include "sim/core/text.hpp"
#include "tools/figures/group_figures.hpp"

namespace gnbv {
namespace {

Series mean_of_group(const DrawnGroup& group, Mark mark) {
  Series series{
      .name = group.label,
      .label = fmt::format("{} ({}){}", group.label, counted(group.curves.size(), "seed", "seeds"),
                           group.has_band() ? ", 95 % interval" : ""),
      .mark = mark,
      .look = group.look,
      .width_pt = kGroupWidth_pt,
      .x = group.mean.x,
      .end = std::array{group.mean.end_x, group.mean.end_y}};
  for (const MeanEstimate& y : group.mean.y) {
    series.y.push_back(y.mean);
    if (!group.has_band()) continue;
    series.low.push_back(y.mean - *y.half_width);
    series.high.push_back(y.mean + *y.half_width);
  }
  return series;
}

/// The paper's row that a group's runs may stand beside, if there is one with a coverage.
const PaperRow* papers_row(const RunGroup& group) {
  const RunFigures& figures = *group.runs.front()->figures;
  const PaperTable* const table = find_paper_table(figures.scenario);
  if (table == nullptr || !is_papers_structure(*table, figures.structure) ||
      !has_papers_setting(group.runs.front()->scenario)) {
    return nullptr;
  }
  const PaperRow* const row = find_row(*table, figures.utility);
  return row != nullptr && row->coverage_percent ? row : nullptr;
}

/// What the paper's rows reached at one of its sizes, each row once: by its name where there are
/// several, and marked where its figure is doubtful.
std::vector<Series> paper_levels(std::span<const RunGroup> groups, std::size_t size) {
  std::vector<std::pair<const PaperRow*, std::string>> rows;
  for (const RunGroup& group : groups) {
    const PaperRow* const row = papers_row(group);
    const auto is_same = [&](const auto& other) { return other.first == row; };
    if (row == nullptr || std::any_of(rows.begin(), rows.end(), is_same)) continue;
    rows.emplace_back(row, label_below(common_scenario(groups), group.label));
  }
  static const std::array<std::vector<double>, 4> kDashes = {
      {{4.0, 3.0}, {2.0, 2.0}, {6.0, 2.5}, {1.2, 3.5}}};
  std::vector<Series> levels;
  for (const auto& [row, label] : rows) {
    const double percent = (*row->coverage_percent)[size];
    const std::string when = row->iterations
                                 ? fmt::format("after its {} views", grouped(*row->iterations, 0))
                                 : "at its end";
    const std::string whose = rows.size() > 1 ? "paper's " + label : "paper";
    levels.push_back({.name = whose,
                      .label = fmt::format("{}, {}: {:.1f} %{}", whose, when, percent,
                                           is_doubtful(*row) ? " (doubtful)" : ""),
                      .mark = Mark::level,
                      .look = {.colour = std::string(kPlotGrey),
                               .dashes = kDashes[levels.size() % kDashes.size()]},
                      .width_pt = 0.7,
                      .y = {percent}});
  }
  return levels;
}

/// The means of the ceilings that are known, each once; the runs of other scenarios have others.
std::vector<Series> ceilings_of(std::span<const RunGroup> groups) {
  std::vector<Series> levels;
  for (const RunGroup& group : groups) {
    std::vector<double> known;
    for (const RunRecord* const run : group.runs) {
      if (run->figures->ceiling) known.push_back(100.0 * *run->figures->ceiling);
    }
    if (known.empty()) continue;
    const double ceiling = mean_of(known);
    const auto is_same = [&](const Series& level) { return std::abs(level.y[0] - ceiling) < 0.05; };
    if (std::any_of(levels.begin(), levels.end(), is_same)) continue;
    levels.push_back({.name = "ceiling",
                      .label = levels.empty() ? "ceiling" : "",
                      .mark = Mark::level,
                      .width_pt = 0.7,
                      .y = {ceiling}});
  }
  return levels;
}

}  // namespace

DrawnGroup::DrawnGroup(std::string name, SeriesLook its_look, std::vector<StepCurve> its_curves)
    : label(std::move(name)),
      look(std::move(its_look)),
      curves(std::move(its_curves)),
      mean(mean_curve(curves)) {}

void add_groups(std::span<const DrawnGroup> groups, Mark mark, FigurePanel& panel,
                std::vector<std::string>& notes) {
  bool has_pair = false;
  bool has_several_ends = false;
  for (const DrawnGroup& group : groups) {
    const MeanCurve& mean = group.mean;
    has_several_ends |= mean.longest_x - mean.shortest_x > 0.01 * mean.end_x;
    if (group.curves.size() != 2) continue;
    has_pair = true;
    for (std::size_t k = 0; k < group.curves.size(); ++k) {
      panel.series.push_back({.name = fmt::format("{}, run {}", group.label, k + 1),
                              .mark = mark,
                              .look = {.colour = group.look.colour},
                              .width_pt = 0.4,
                              .x = group.curves[k].x,
                              .y = group.curves[k].y});
    }
  }
  for (const DrawnGroup& group : groups) panel.series.push_back(mean_of_group(group, mark));
  if (has_pair) notes.emplace_back("thin: each of two seeds; thick: their mean");
  if (has_several_ends) notes.emplace_back("mark: mean end of the seeds");
}

std::vector<Series> coverage_levels(std::span<const RunGroup> groups, double size_m) {
  const std::optional<std::size_t> size = papers_size(size_m);
  if (!size) return {};
  std::vector<Series> levels = *size == 0 ? ceilings_of(groups) : std::vector<Series>{};
  for (Series& level : paper_levels(groups, *size)) levels.push_back(std::move(level));
  return levels;
}

}  // namespace gnbv
