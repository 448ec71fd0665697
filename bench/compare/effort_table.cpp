#include "bench/compare/effort_table.hpp"

#include <fmt/format.h>

#include <limits>

#include "bench/compare/statistics.hpp"
#include "bench/compare/table_groups.hpp"
#include "bench/score/run_figures.hpp"
#include "sim/core/text.hpp"

namespace gnbv {
namespace {

constexpr std::size_t kFirstShare = 1;  // of kReachShares: 80 % is what every method passes

TableCell metres_cell(const TableGroup& group, double coverage) {
  std::vector<double> metres;
  std::size_t there = 0;
  for (const RunFigures* run : group.runs) {
    if (run->curve.coverage.empty()) return {.text = "-"};  // nobody knows
    const auto spent = effort_to_reach(run->curve, run->before, coverage);
    metres.push_back(spent ? spent->metres : std::numeric_limits<double>::infinity());
    there += spent ? 1 : 0;
  }
  const std::optional<double> median = median_effort(metres);
  return {.text = fmt::format("{} ({} of {})", median ? grouped(*median, 1) : "-", there,
                              group.runs.size()),
          .values = {median, static_cast<double>(there)}};
}

}  // namespace

TextTable effort_table(const PaperTable& paper, std::span<const RunFigures> runs,
                       const std::optional<Ceiling>& ceiling,
                       std::span<const std::string> settings) {
  using enum ColumnKind;
  TextTable table;
  table.title = "Metres to reach the ceiling";
  table.columns = {{"Utility", "utility", text}, {"Row", "row", text}};
  for (std::size_t i = kFirstShare; i < kReachShares.size(); ++i) {
    const double percent = 100.0 * kReachShares[i];
    table.columns.push_back(
        {fmt::format("{:.0f}%", percent), fmt::format("metres_to_{:.0f}", percent), counted});
  }
  if (!ceiling || ceiling->leaf_outside[0] <= 0.0) return table;
  const auto add_row = [&](const TableGroup& group) {
    auto& row = table.rows.emplace_back();
    row = {{.text = group.label(name_in_table(paper, group.utility))}, {.text = "ours"}};
    for (std::size_t i = kFirstShare; i < kReachShares.size(); ++i) {
      row.push_back(metres_cell(group, kReachShares[i] * ceiling->leaf_outside[0]));
    }
  };
  const std::vector<TableGroup> groups = table_groups(runs, settings);
  for (const PaperRow& row : paper.rows) {
    for (const TableGroup& group : groups) {
      if (group.utility == row.utility) add_row(group);
    }
  }
  for (const TableGroup& group : groups) {
    if (find_row(paper, group.utility) == nullptr) add_row(group);
  }
  if (!table.rows.empty()) {
    table.notes.emplace_back(
        "metres to 90 to 99% of the ceiling: median over the runs of the distance, profile apart, "
        "until the cloud first covered so much at 0.05 m of what it can hold, and how many runs "
        "got "
        "there; one that did not counts as farther than all others");
  }
  return table;
}

}  // namespace gnbv
