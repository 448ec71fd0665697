// iterations.csv: one row a view. Numbers are written so that they read back exactly.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/mission/mission_result.hpp"
#include "tools/mission/score.hpp"

namespace gnbv {

std::string iterations_csv_header();
std::string iterations_csv_row(const ViewRecord& view);

/// The decisions of an iterations.csv, oldest first. A last line without its end, as a killed run
/// leaves it, is left out. Throws BadInput naming file and line for anything else it cannot read.
std::vector<Decision> read_decisions(const std::filesystem::path& csv);

/// How far the mission was after each view, read the same way.
std::vector<ViewMark> read_view_marks(const std::filesystem::path& csv);

}  // namespace gnbv
