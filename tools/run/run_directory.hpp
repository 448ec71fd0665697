// The run directory: what a mission writes, row by row while it runs and whole when it ends. The
// README says what each file holds.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/score/mission_score.hpp"
#include "scenarios/scenario.hpp"
#include "tools/run/iterations_csv.hpp"
#include "tools/run/mission_result.hpp"
#include "tools/run/run_files.hpp"

namespace gnbv {

/// Throws BadInput for a folder that holds a run already when `resume` is false, a run of another
/// scenario, or anything else that is no run. Writes nothing.
void need_usable(const std::filesystem::path& folder, const Scenario& scenario, bool resume);

class RunDirectory {
 public:
  /// Makes the folder, writes scenario.yaml and removes what killed writers left. Throws as
  /// need_usable(), as refuse_to_write(), and BadInput naming file and line for a record of views
  /// that is damaged, was edited, or leads out of the workspace.
  RunDirectory(std::filesystem::path folder, const Scenario& scenario, bool resume);

  const std::filesystem::path& path() const { return folder_; }

  /// Views of the run that is resumed, oldest first; none for a new one.
  const std::vector<ViewRecord>& recorded() const { return recorded_; }
  std::vector<Decision> recorded_decisions() const;

  /// Throws BadInput naming view and quantity when a view flown again is another than its record:
  /// another program, or another world, made the record.
  void need_as_recorded(const ViewRecord& view) const;

  /// Throws BadInput when a mission that flew the record again comes to another result: it ended
  /// before the record did, or is not what the finished run was.
  void need_as_recorded(const MissionResult& result) const;

  /// Writes profile.map, which another mission can begin with (planner.profiling.method: saved).
  void write_profile(const Belief& belief) const;

  /// Appends a row to the journal and flushes it: a killed run loses at most the view it was busy
  /// with.
  void append(const ViewRecord& view);

  /// Keeps the last of the views that the mission was given, one by one: views.csv.part grows by
  /// it, and finish() writes all into scenario.yaml.
  void keep(std::span<const ViewPose> views);

  /// Removes the old summary.json, writes every file, removes the journals and writes summary.json
  /// when the others are on the disk; each by rename.
  void finish(const Scenario& scenario, const MissionResult& result, const MissionScore& score,
              double total_wall_s);

 private:
  std::filesystem::path folder_;
  Columns columns_;
  std::vector<ViewRecord> recorded_;
  std::string finished_sha256_;  // result_sha256 of a recorded run that was finished
  JournalRows rows_;
  std::string pending_;  // rows of recorded views that are being flown again
  std::optional<GrowingFile> journal_;
  std::optional<GrowingFile> given_views_;
};

}  // namespace gnbv
