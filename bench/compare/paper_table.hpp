// Missions beside the paper's figures, the oracles and the ceiling.
#pragma once

#include <span>
#include <string>

#include "bench/compare/mission_row.hpp"
#include "bench/compare/paper_figures.hpp"
#include "bench/compare/text_table.hpp"

namespace gnbv {

/// Ours beside the paper's: per method a row of the mean over its missions (with 95 % intervals if
/// there are several) and the paper's row, in the paper's order; then methods the paper lacks, the
/// profile, and the ceilings. Where ours took more views than the paper's, a row has it after as
/// many. Distances are straight_m, times end with the last view and begin with the first.
/// `missions` may be of any methods, settings and seeds of one scenario, a setting of a method is a
/// row; none at all gives the paper alone.
TextTable comparison_table(const PaperTable& paper, std::span<const MissionRow> missions);

/// Columns that effort_table() shares with comparison_table(): utility, row.
constexpr std::size_t kSharedColumns = 2;

/// What each method spends until its cloud holds most of what a cloud can hold. A row for each of
/// ours in comparison_table(), named alike: for kReachShares of the ceiling the median, how many
/// missions got there within the budget, and the mean in which the others have spent it; of a
/// mission and those of its method and seed that were flown for one share (kForShare) the least.
/// Where half of them did not get there, there is no median. Of energy also how many of all got
/// there on one battery. Without a ceiling, or missions, no rows; no column of what nobody knows.
TextTable effort_table(const PaperTable& paper, Effort effort,
                       std::span<const MissionRow> missions);

/// The same of one share, 95 %: seconds, metres and energy from take-off, to stand beside the
/// paper's columns.
TextTable take_off_table(const PaperTable& paper, std::span<const MissionRow> missions);

/// The mission's row as a small aligned table; below it, if the mission's setting is the paper's,
/// the paper's row for its scenario, method and structure, where it has one. For a terminal of
/// that width; 0: as wide as it takes.
std::string one_row_summary(const MissionRow& mission, bool has_papers_setting,
                            std::size_t width = 0);

}  // namespace gnbv
