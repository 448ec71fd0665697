// Missions beside the paper's figures, the oracles and the ceiling.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "bench/compare/paper_figures.hpp"
#include "bench/compare/text_table.hpp"
#include "bench/limits/ceiling.hpp"
#include "bench/score/run_figures.hpp"

namespace gnbv {

/// Ours beside the paper's: per utility a row of the mean over its runs (with 95 % intervals if
/// there are several) and the paper's row, in the paper's order; then utilities the paper lacks,
/// the profile, and the ceilings. Where ours took more views than the paper's, a row has it after
/// as many. Distances are straight_m, times end with the last view and begin with the first. `runs`
/// may hold any utilities and seeds of one scenario; none at all gives the paper alone. `settings`
/// names, for each run, what tells its configuration from others of its utility: runs of two
/// settings are two rows. None: all runs have the same.
TextTable comparison_table(const PaperTable& paper, std::span<const RunFigures> runs,
                           const std::optional<Ceiling>& ceiling,
                           std::span<const std::string> settings = {});

/// Columns that effort_table() shares with comparison_table(): utility, row.
constexpr std::size_t kSharedColumns = 2;

/// By kReachShares: runs that were flown for this share alone.
using RunsByShare = std::array<std::vector<RunFigures>, kReachShares.size()>;

/// What each method spends until its cloud holds most of what a cloud can hold. A row for each of
/// ours in comparison_table(), named alike: the median metres or seconds (from the first view on)
/// to kReachShares of the ceiling, and how many runs got there; of utilities in `by_share`, its
/// runs. A run that did not counts as one that needs more than any other; where half of them did
/// not, there is no median. Without a ceiling, or runs, no rows.
TextTable effort_table(const PaperTable& paper, Effort effort, std::span<const RunFigures> runs,
                       const std::optional<Ceiling>& ceiling,
                       std::span<const std::string> settings = {},
                       const RunsByShare& by_share = {});

/// The mission's row as a small aligned table; below it, if the mission's setting is the paper's,
/// the paper's row for its scenario, utility and structure, where it has one. For a terminal of
/// that width; 0: as wide as it takes.
std::string one_row_summary(const RunFigures& run, bool has_papers_setting, std::size_t width = 0);

}  // namespace gnbv
