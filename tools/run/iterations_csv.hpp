// iterations.csv: one row a view. Numbers are written so that they read back exactly.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scenarios/scenario.hpp"
#include "tools/run/mission_result.hpp"

namespace gnbv {

/// Runs of a vehicle with a gimbal have a column more, its pitch in radians; those of a planner of
/// bursts the number of each view in its plan, from 1 on: with the others nothing was decided; and
/// all but those of older versions the energy.
struct Columns {
  bool gimbal = false;
  bool plans = false;
  bool energy = false;
};
Columns columns_of(const Scenario& scenario);

std::string iterations_csv(std::span<const ViewRecord> views, Columns columns = {});

/// The rows of a run that goes on: a column more, `check`, is made of each row and of all before
/// it, so that no change of them goes unnoticed.
class JournalRows {
 public:
  explicit JournalRows(Columns columns) : columns_(columns) {}
  std::string header() const;
  std::string row(const ViewRecord& view);  // the next one

 private:
  Columns columns_;
  std::string check_;  // of the last row
};

/// The first column, wall times aside, in which a view is another than was recorded: its name and
/// both values. Nothing: they are the same.
struct Difference {
  std::string column;
  std::string now;
  std::string recorded;
};
std::optional<Difference> first_difference(const ViewRecord& now, const ViewRecord& recorded);

/// SHA-256 of all columns but wall times; of views without a known energy as older versions had it.
std::string views_sha256(std::span<const ViewRecord> views);

/// The columns from `sampler` to `time_s`, with commas between: why the view was chosen and how far
/// the mission was after it.
std::string decision_header();
std::string decision_cells(const ViewRecord& view);

/// The rows of an iterations.csv, oldest first; wall times to the microsecond. A last line without
/// its end, as a killed run leaves it, is left out. Throws BadInput naming file and line for
/// anything else it cannot read, and for a row of a journal that is not as it was written.
std::vector<ViewRecord> read_view_records(const std::filesystem::path& csv);

}  // namespace gnbv
