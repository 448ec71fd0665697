// An entry of the suite while it is made: a folder with a planner's missions of one track.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "bench/suite/submission.hpp"
#include "tools/sweep/run_cells.hpp"
#include "tools/sweep/sweep.hpp"

namespace gnbv {

/// Who flies: a planner of the program's by its settings, a function in a Python file, or a command
/// that speaks the view exchange.
struct EntryPlanner {
  std::string name;
  EntryKind kind = EntryKind::planner;
  std::vector<Override> settings = {};          // as a submission states them
  std::vector<Override> asks = {};              // of kind `views`, after these: the mission asks it
  std::vector<std::string> run_arguments = {};  // of `gnbv run`
};

/// Of NAME, FILE.py:FUNCTION or COMMAND, with further settings KEY=VALUE. `name`: instead of the
/// planner's own. Throws BadInput for a word that is none of these, and for a utility in a file.
EntryPlanner entry_planner(const std::string& text, const std::vector<std::string>& settings,
                           const std::string& name);

/// What is flown around in tasks, as scenarios; meshes of random structures are written to a
/// folder.
class TaskScenarios {
 public:
  /// Both stay with the caller.
  TaskScenarios(const Suite& suite, std::filesystem::path mesh_folder)
      : suite_(suite), meshes_(std::move(mesh_folder)) {}

  /// The task as every planner gets it.
  Scenario of(const SuiteTask& task);
  /// As this planner flies it. Throws BadInput naming each key that it may not set.
  Scenario of(const SuiteTask& task, const std::vector<Override>& planner);
  /// SHA-256 of the structure's mesh, as inputs.json of a run has it.
  std::string mesh_sha256(const SuiteStructure& structure);

 private:
  Scenario resolved(const SuiteTask& task, const std::vector<Override>& planner);
  std::string mesh_of(const SuiteStructure& structure);  // path, "" of the scenario's own

  const Suite& suite_;
  std::filesystem::path meshes_;
  std::map<std::string, std::string> hashes_;
};

/// The tasks of a track, or of them those whose structures are asked for. Throws BadInput for one
/// that it lacks.
std::vector<SuiteTask> asked_tasks(const Suite& suite, const std::string& track,
                                   const std::vector<std::string>& only);

/// The missions of an entry, task by task. Throws BadInput when a mesh is another than was frozen,
/// and for settings that name code, another planner than is entered, or an oracle by whose name the
/// entry's does not begin.
std::vector<Cell> cells_of_entry(const Suite& suite, const std::vector<SuiteTask>& tasks,
                                 const EntryPlanner& planner, TaskScenarios& scenarios);

// ---- entry_folder.cpp: DIR/bench.json and DIR/suite.yaml say whose missions the folder holds

struct EntryFolder {
  Suite suite;
  std::string track;
  EntryPlanner planner;
};

/// Makes the folder that of an entry, or finds that it is: BadInput for a folder of another, for
/// one of this without `resume`, and for one with other things in it.
void claim_entry_folder(const std::filesystem::path& folder, const EntryFolder& entry, bool resume);

/// Throws BadInput naming what is missing or damaged.
EntryFolder read_entry_folder(const std::filesystem::path& folder);

/// A folder of its own among the temporary ones, gone in the end.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Mean planning time of a view, and the records of a mission that a submission holds: by file name
/// of submission.hpp.
double planning_s(const std::filesystem::path& run);
std::map<std::string, std::string> mission_records(const std::filesystem::path& run,
                                                   EntryKind kind);

/// The mission of a task as a submission tells it, its files without their hashes.
SubmittedMission mission_of_run(const std::filesystem::path& run, const SuiteTask& task,
                                const SuiteTrack& track, EntryKind kind);

}  // namespace gnbv
