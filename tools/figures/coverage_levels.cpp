#include "tools/figures/coverage_levels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "bench/compare/paper_figures.hpp"
#include "bench/compare/statistics.hpp"
#include "scenarios/load.hpp"
#include "sim/core/text.hpp"

namespace gnbv {
namespace {

/// What the paper's rows reached at one of its sizes, each row once: by its name where there are
/// several, and marked where its figure is doubtful.
std::vector<Series> paper_levels(std::span<const RunGroup> groups, std::size_t size) {
  std::vector<std::pair<const PaperRow*, std::string>> rows;
  const std::string title = common_scenario(groups);
  for (const RunGroup& group : groups) {
    const RunFigures& figures = *group.runs.front()->figures;
    const PaperTable* const table = find_paper_table(figures.scenario);
    if (table == nullptr || !is_papers_structure(*table, figures.structure) ||
        !has_papers_setting(group.runs.front()->scenario)) {
      continue;
    }
    const PaperRow* const row = find_row(*table, figures.utility);
    const auto is_same = [&](const auto& other) { return other.first == row; };
    if (row == nullptr || !row->coverage_percent || std::any_of(rows.begin(), rows.end(), is_same))
      continue;
    rows.emplace_back(row, label_below(title, group.label));
  }
  static const std::array<std::vector<double>, 4> kDashes = {
      {{4.0, 3.0}, {2.0, 2.0}, {6.0, 2.5}, {1.2, 3.5}}};
  std::vector<Series> levels;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& [row, label] = rows[i];
    const double percent = (*row->coverage_percent)[size];
    const std::string when =
        row->iterations
            ? fmt::format("after its {}",
                          counted(static_cast<std::size_t>(*row->iterations), "view", "views"))
            : "at its end";
    const std::string whose = rows.size() > 1 ? "paper's " + label : "paper";
    levels.push_back(
        {.name = whose,
         .label = fmt::format("{}, {}: {:.1f} %{}", whose, when, percent,
                              is_doubtful(*row) ? " (doubtful)" : ""),
         .mark = Mark::level,
         .look = {.colour = std::string(kPlotGrey), .dashes = kDashes[i % kDashes.size()]},
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

std::vector<Series> coverage_levels(std::span<const RunGroup> groups, double size_m) {
  const std::optional<std::size_t> size = papers_size(size_m);
  if (!size) return {};
  std::vector<Series> levels = *size == 0 ? ceilings_of(groups) : std::vector<Series>{};
  for (Series& level : paper_levels(groups, *size)) levels.push_back(std::move(level));
  return levels;
}

}  // namespace gnbv
