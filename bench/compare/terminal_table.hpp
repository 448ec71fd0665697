// Tables that fit a terminal.
#pragma once

#include <cstddef>
#include <string>

#include "bench/compare/text_table.hpp"

namespace gnbv {

/// Aligned columns for a terminal of that width (0: as wide as it takes); ends with a line feed.
/// What is wider is made narrow, by no more than it takes: heads are folded at blanks; columns that
/// say the same in every row become a note; all names but the last become lines above their rows;
/// words on the right are folded; columns go into blocks below each other. No cell is ever cut.
std::string terminal_text(const TextTable& table, std::size_t width = 0);

}  // namespace gnbv
