// iterations.csv: one row a view. Numbers are written so that they read back exactly.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "scenarios/scenario.hpp"
#include "tools/run_files/mission_result.hpp"

namespace gnbv {

/// Runs of a vehicle with a gimbal have a column more, its pitch in radians.
enum class Columns { usual, with_gimbal };
Columns columns_of(const Scenario& scenario);

std::string iterations_csv_header(Columns columns = Columns::usual);
std::string iterations_csv_row(const ViewRecord& view, Columns columns = Columns::usual);
std::string iterations_csv(std::span<const ViewRecord> views, Columns columns = Columns::usual);

/// The columns from `sampler` to `time_s`, with commas between: why the view was chosen and how far
/// the mission was after it.
std::string decision_header();
std::string decision_cells(const ViewRecord& view);

/// The rows of an iterations.csv, oldest first; wall times to the microsecond. A last line without
/// its end, as a killed run leaves it, is left out. Throws BadInput naming file and line for
/// anything else it cannot read.
std::vector<ViewRecord> read_view_records(const std::filesystem::path& csv);

/// Only what was decided.
std::vector<Decision> read_decisions(const std::filesystem::path& csv);

}  // namespace gnbv
