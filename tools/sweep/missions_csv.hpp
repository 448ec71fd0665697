// Missions as rows of a CSV file: raw data that tables are printed from, and that says what need
// not be flown again.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "bench/compare/mission_row.hpp"

namespace gnbv {

/// RFC 4180: the words of a row, then a column a figure, by name. Numbers read back exactly; "inf"
/// for what was not reached, nothing for what is not known. A mesh is named without its folders.
std::string missions_csv(std::span<const MissionRow> missions);

/// Throws BadInput naming file, line and column of what is missing or no number, and of the second
/// of two rows of one scenario, method, setting and seed.
std::vector<MissionRow> read_missions(const std::filesystem::path& csv);

}  // namespace gnbv
