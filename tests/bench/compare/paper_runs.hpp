// Missions of the paper's tables made by hand, and what tables of them hold.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/compare/paper_table.hpp"

namespace gnbv {

using Texts = std::vector<std::string>;

inline RunFigures example() {
  RunFigures r;
  r.scenario = "aircraft";
  r.structure = "aircraft";
  r.utility = "proposed";
  r.termination = "max_iterations";
  r.seed = 1;
  r.iterations = 635;
  r.entropy_reduction_nat = 3702.4;
  r.straight_m = 504.26;
  r.flown_m = 530.0;
  r.before.profile_m = 349.0;
  r.coverage_final = {0.852, 0.95, 0.9951};
  r.coverage_profile = {0.167, 0.666, 0.896};
  r.coverage_final_raw = {0.75, 0.85, 0.95};
  r.density_points_per_voxel = 103.2;
  r.wall_s = 61.0;
  return r;
}

inline Texts texts(const std::vector<TableCell>& row) {
  Texts all;
  for (const TableCell& cell : row) all.push_back(cell.text);
  return all;
}

inline std::vector<Texts> all_texts(const TextTable& table) {
  std::vector<Texts> all;
  for (const auto& row : table.rows) all.push_back(texts(row));
  return all;
}

inline const TableCell& cell_of(const TextTable& table, std::size_t row, std::string_view key) {
  const auto column = std::find_if(table.columns.begin(), table.columns.end(),
                                   [&](const TableColumn& c) { return c.key == key; });
  return table.rows.at(row).at(static_cast<std::size_t>(column - table.columns.begin()));
}

/// `settings`: of each, or of none.
inline std::vector<MissionRow> rows_of(std::span<const RunFigures> runs,
                                       const std::optional<Ceiling>& ceiling = {},
                                       const std::vector<std::string>& settings = {}) {
  std::vector<MissionRow> rows;
  for (const RunFigures& run : runs) {
    MissionRow& row = rows.emplace_back(mission_row(run));
    if (ceiling) add_ceiling(run, *ceiling, row);
    if (!settings.empty()) row.setting = settings.at(rows.size() - 1);
  }
  return rows;
}

}  // namespace gnbv
