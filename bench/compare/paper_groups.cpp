#include "bench/compare/paper_groups.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

#include "bench/compare/statistics.hpp"
#include "bench/score/sized_coverage.hpp"
#include "bench/score/voxel_set.hpp"

namespace gnbv {
namespace {

Figures beside_papers(const MissionRow& mission) {
  Figures figures = with_prefix(mission.figures, kCut);
  figures.insert(mission.figures.begin(), mission.figures.end());
  return figures;
}

/// A figure of each mission; fewer where some do not know it.
std::vector<double> values_beside(const PaperGroup& group, const std::string& name) {
  std::vector<double> values;
  for (const MissionRow* const mission : group.missions) {
    const Figures figures = beside_papers(*mission);
    if (const auto at = figures.find(name); at != figures.end()) values.push_back(at->second);
  }
  return values;
}

}  // namespace

std::vector<PaperGroup> paper_groups(const PaperTable& paper,
                                     std::span<const MissionRow> missions) {
  std::vector<PaperGroup> groups;
  for (const MissionRow& mission : missions) {
    auto group = std::ranges::find_if(groups, [&](const PaperGroup& g) {
      return g.method == mission.method && g.setting == mission.setting;
    });
    if (group == groups.end()) {
      const std::string name = name_in_table(paper, mission.method);
      const std::string comma = mission.setting.empty() ? "" : ", ";
      group = groups.insert(groups.end(),
                            {mission.method, mission.setting, name + comma + mission.setting});
    }
    group->missions.push_back(&mission);
  }
  std::ranges::stable_sort(groups, {}, [&](const PaperGroup& group) {
    const PaperRow* const row = find_row(paper, group.method);
    return row == nullptr ? std::ssize(paper.rows) : row - paper.rows.data();
  });
  return groups;
}

Figures printed_in(const PaperRow& row) {
  Figures printed;
  const auto add = [&](const std::string& key, const auto& value, double unit = 1.0) {
    if (value) printed[key] = *value / unit;
  };
  add("iterations", row.iterations);
  add("entropy_reduction", row.entropy_reduction);
  add("distance_m", row.distance_m);
  add("time_min", row.time_min);
  add("density_points_per_voxel", row.density_points_per_voxel);
  for (std::size_t i = 0; row.coverage_percent && i < kCoverageSizes_m.size(); ++i) {
    const std::optional percent = (*row.coverage_percent)[i];
    add("coverage_" + size_name(kCoverageSizes_m[i]), percent, 100.0);
  }
  return printed;
}

std::vector<TableCell> place_cells(const PaperGroup& group, const PaperRow& paper,
                                   std::span<const TableColumn> columns) {
  std::vector<TableCell> cells;
  const Figures printed = printed_in(paper);
  for (const TableColumn& column : columns) {
    TableCell& cell = cells.emplace_back();
    const auto at = printed.find(column.key);
    if (at == printed.end() || column.key == "iterations") continue;
    const std::vector<double> values = values_beside(group, column.key);
    if (values.size() < group.missions.size()) continue;
    const double share = share_below(values, at->second);
    cell = {fmt::format("{:.0f} % below", 100.0 * share), {share}};
  }
  return cells;
}

std::string order_note(const PaperTable& paper, std::span<const PaperGroup> groups) {
  constexpr std::array<std::pair<const char*, const char*>, 3> kOrdered = {
      {{"coverage_0.05", "coverage at 0.05 m"},
       {"distance_m", "distance"},
       {"entropy_reduction", "entropy reduction"}}};
  std::string note;
  for (const auto& [key, words] : kOrdered) {
    std::vector<std::pair<double, const PaperGroup*>> printed;
    for (const PaperGroup& group : groups) {
      const PaperRow* const row = find_row(paper, group.method);
      if (row == nullptr || group.missions.size() < 2) continue;
      const Figures figures = printed_in(*row);
      if (const auto at = figures.find(key); at != figures.end()) {
        printed.emplace_back(at->second, &group);
      }
    }
    std::ranges::stable_sort(printed, std::greater{}, &std::pair<double, const PaperGroup*>::first);
    if (printed.size() < 2) continue;
    std::vector<std::vector<double>> values;
    std::string order;
    for (const auto& [figure, group] : printed) {
      order += (order.empty() ? "" : " > ") + group->name;
      values.push_back(values_beside(*group, key));
    }
    note += fmt::format("{}{} {}: {:.0f} %", note.empty() ? "" : ", ", words, order,
                        100.0 * share_descending(values));
  }
  return note;
}

}  // namespace gnbv
