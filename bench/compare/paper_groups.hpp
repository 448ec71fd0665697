// Missions of a paper's table by row: what they came to, and where the paper's figures lie among
// theirs.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/compare/mission_row.hpp"
#include "bench/compare/paper_figures.hpp"
#include "bench/compare/text_table.hpp"

namespace gnbv {

/// Missions of one row, which differ in their seeds alone.
struct PaperGroup {
  std::string method;
  std::string setting;
  std::string name;  // of the row: "Proposed, exact sensors"
  std::vector<const MissionRow*> missions = {};
};

/// The setting of missions that a planner flew for one share of the ceiling alone: "for 0.95".
/// They stand in effort_table() and nowhere else.
constexpr std::string_view kForShare = "for ";

/// Those of the paper's methods in its order, then the others in that of their first missions.
std::vector<PaperGroup> paper_groups(const PaperTable& paper, std::span<const MissionRow> missions);

/// What a row prints, under the names of figures_of().
Figures printed_in(const PaperRow& row);

/// Of each figure that the paper prints, the share of our missions that lie below it, as a row of
/// the table: after as many views, or at the end of those that took fewer; entropy and density at
/// the end.
std::vector<TableCell> place_cells(const PaperGroup& group, const PaperRow& paper,
                                   std::span<const TableColumn> columns);

/// "coverage at 0.05 m Proposed > Isler: 31 %, ...", of what the paper prints for each of its
/// methods: how many sets of single missions, one of each method, have its order. Empty where two
/// methods with two missions each are not there.
std::string order_note(const PaperTable& paper, std::span<const PaperGroup> groups);

}  // namespace gnbv
