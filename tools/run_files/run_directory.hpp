// The run directory: what a mission writes, row by row while it runs and whole when it ends. The
// README says what each file holds.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "bench/score/mission_score.hpp"
#include "scenarios/scenario.hpp"
#include "tools/run_files/iterations_csv.hpp"
#include "tools/run_files/mission_result.hpp"

namespace gnbv {

/// Throws BadInput for a folder that holds a run already when `resume` is false, a run of another
/// scenario, or anything else that is no run. Writes nothing.
void need_usable(const std::filesystem::path& folder, const Scenario& scenario, bool resume);

class RunDirectory {
 public:
  /// Makes the folder and writes scenario.yaml. Throws BadInput when it cannot be written, and as
  /// need_usable().
  RunDirectory(std::filesystem::path folder, const Scenario& scenario, bool resume);

  const std::filesystem::path& path() const { return folder_; }

  /// Decisions of the run that is resumed, oldest first; empty for a new one.
  const std::vector<Decision>& recorded() const { return recorded_; }

  /// Writes profile.map, which another mission can begin with (planner.profiling.method: saved).
  void write_profile(const Belief& belief) const;

  /// Appends a row to the journal and flushes it: a killed run loses at most the view it was busy
  /// with.
  void append(const ViewRecord& view);

  /// Writes scenario.yaml anew, for a mission that learns its views on the way.
  void keep(const Scenario& scenario) const;

  /// Writes every file, summary.json last, each by rename, and removes the journal.
  void finish(const Scenario& scenario, const MissionResult& result, const MissionScore& score,
              double total_wall_s);

 private:
  std::filesystem::path journal_file() const;

  std::filesystem::path folder_;
  Columns columns_;
  std::vector<Decision> recorded_;
  std::string pending_;  // rows of recorded views that are being flown again
  std::ofstream journal_;
};

}  // namespace gnbv
