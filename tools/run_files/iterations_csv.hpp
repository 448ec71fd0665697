// iterations.csv: one row a view. Numbers are written so that they read back exactly.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/score/mission_score.hpp"
#include "tools/run_files/mission_result.hpp"

namespace gnbv {

std::string iterations_csv_header();
std::string iterations_csv_row(const ViewRecord& view);

/// The rows of an iterations.csv, oldest first, without the wall times. A last line without its
/// end, as a killed run leaves it, is left out. Throws BadInput naming file and line for anything
/// else it cannot read.
std::vector<ViewRecord> read_view_records(const std::filesystem::path& csv);

/// Only what was decided.
std::vector<Decision> read_decisions(const std::filesystem::path& csv);

/// Only how far the mission was after each view.
std::vector<ViewMark> read_view_marks(const std::filesystem::path& csv);

}  // namespace gnbv
