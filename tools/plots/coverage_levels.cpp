#include "tools/plots/coverage_levels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/compare/paper_figures.hpp"
#include "scenarios/load.hpp"
#include "tools/plots/script_parts.hpp"
#include "tools/run/words.hpp"

namespace gnbv {
namespace {

/// What the paper's rows reached, each row once: its name where there are several.
void add_paper_levels(std::span<const RunGroup> groups, std::size_t size,
                      std::vector<CoverageLevel>& levels) {
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
  constexpr std::array<std::string_view, 4> kDashes = {"(6,5)", "(3,3)", "(10,4)", "(2,6)"};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& [row, label] = rows[i];
    const double percent = (*row->coverage_percent)[size];
    const std::string when = row->iterations
                                 ? fmt::format("after its {}", counted(*row->iterations, "view"))
                                 : "at its end";
    const std::string text =
        fmt::format("paper{}, {}: {:.1f} %{}", rows.size() > 1 ? "'s " + label : "", when, percent,
                    is_doubtful(*row) ? " (doubtful)" : "");
    const std::string_view dashes = kDashes[i % kDashes.size()];
    levels.push_back({percent, {.colour = kPlotGrey, .text = text, .line = 0.9, .dashes = dashes}});
  }
}

/// The means of the ceilings that are known; the runs of other scenarios have others.
void add_ceilings(std::span<const RunGroup> groups, std::vector<CoverageLevel>& levels) {
  const std::size_t before = levels.size();
  for (const RunGroup& group : groups) {
    std::vector<double> known;
    for (const RunRecord* const run : group.runs) {
      if (run->figures->ceiling) known.push_back(100.0 * *run->figures->ceiling);
    }
    if (known.empty()) continue;
    const double ceiling = estimate_mean(known).mean;
    const auto is_same = [&](const CoverageLevel& level) {
      return std::abs(level.percent - ceiling) < 0.05;
    };
    if (std::any_of(levels.begin() + static_cast<std::ptrdiff_t>(before), levels.end(), is_same))
      continue;
    levels.push_back({ceiling, {.colour = kPlotInk, .text = "ceiling", .line = 0.9}});
  }
}

}  // namespace

std::vector<CoverageLevel> coverage_levels(std::span<const RunGroup> groups, std::size_t size) {
  std::vector<CoverageLevel> levels;
  if (size == 0) add_ceilings(groups, levels);
  add_paper_levels(groups, size, levels);
  return levels;
}

}  // namespace gnbv
