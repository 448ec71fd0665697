// What each method spends until its cloud holds most of what a cloud can hold.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "bench/compare/paper_figures.hpp"
#include "bench/compare/text_table.hpp"
#include "bench/limits/ceiling.hpp"
#include "bench/score/run_figures.hpp"

namespace gnbv {

/// Columns that effort_table() shares with comparison_table() of paper_table.hpp: utility, row.
constexpr std::size_t kSharedColumns = 2;

/// A row for each of ours in comparison_table(), named alike: the median metres (from the first
/// view on) to 90, 95, 98 and 99 % of the ceiling, and how many runs got there. A run that did not
/// counts as one that needs more than any other; where half of them did not, there is no median.
/// Without a ceiling, or runs, no rows.
TextTable effort_table(const PaperTable& paper, std::span<const RunFigures> runs,
                       const std::optional<Ceiling>& ceiling,
                       std::span<const std::string> settings = {});

}  // namespace gnbv
