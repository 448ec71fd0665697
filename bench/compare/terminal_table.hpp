// Tables that fit a terminal.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "bench/compare/text_table.hpp"

namespace gnbv {

/// terminal_text() for a terminal of that width (0: as wide as it takes). What is wider is folded:
/// first heads at blanks, then columns into blocks below each other that each begin with the
/// columns of text; notes at blanks. No cell is ever cut.
std::string terminal_text(const TextTable& table, std::size_t width);

/// Lines of at most `width` code points where blanks allow it; 0: as it is. Line feeds stay.
std::string folded_text(std::string_view text, std::size_t width);

}  // namespace gnbv
