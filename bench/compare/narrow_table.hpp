// What a table can do without where a terminal is narrow.
#pragma once

#include "bench/compare/text_table.hpp"

namespace gnbv {

/// Without the columns that say the same in every row, and those that repeat the one before them: a
/// first note names them instead. At least one name stays on the left. Tables of one or two rows
/// keep all.
TextTable without_constants(TextTable table);

/// How many columns of text are on the left.
std::size_t names_of(const TextTable& table);

}  // namespace gnbv
