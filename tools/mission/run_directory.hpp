// The run directory: what a mission writes, row by row while it runs and whole when it ends. The
// README says what each file holds.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "scenarios/scenario.hpp"
#include "tools/mission/mission_result.hpp"
#include "tools/mission/score.hpp"

namespace gnbv {

class RunDirectory {
 public:
  /// Makes the folder and writes scenario.yaml. Throws BadInput when it cannot be written, when it
  /// holds a run already and `resume` is false, or when it holds a run of another scenario.
  RunDirectory(std::filesystem::path folder, const Scenario& scenario, bool resume);

  const std::filesystem::path& path() const { return folder_; }

  /// Decisions of the run that is resumed, oldest first; empty for a new one.
  const std::vector<Decision>& recorded() const { return recorded_; }

  /// Writes profile.map, which another mission can begin with (planner.profiling.method: saved).
  void write_profile(const Belief& belief) const;

  /// Appends a row to the journal and flushes it: a killed run loses at most the view it was busy
  /// with.
  void append(const ViewRecord& view);

  /// Writes every file, summary.json last, each by rename, and removes the journal.
  void finish(const Scenario& scenario, const MissionResult& result, const MissionScore& score,
              double total_wall_s);

 private:
  std::filesystem::path folder_;
  std::vector<Decision> recorded_;
  std::string pending_;  // rows of recorded views that are being flown again
  std::ofstream journal_;
};

}  // namespace gnbv
