// What `gnbv bench` does: entries are flown, made a file, flown again by others, and shown.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/figures/figure.hpp"
#include "tools/suite/entry.hpp"

namespace gnbv {

/// How missions are flown.
struct SuiteFlights {
  int jobs = 1;
  int threads = 0;
  bool quiet = false;
  std::vector<std::string> only = {};  // of verifying: these tasks; empty: all
};

/// Flies what is missing of an entry into FOLDER. Throws CommandFailed when it is interrupted or a
/// mission fails, with the first failure.
void fly_entry(const std::filesystem::path& folder, const EntryFolder& entry,
               const std::vector<SuiteTask>& tasks, const SuiteFlights& flights);

/// What people say of their entry.
struct EntryWords {
  std::string description, licence;
};

/// The submission of a folder whose missions are all flown. Throws BadInput naming the tasks that
/// are not flown, or not frozen yet.
Submission submission_of(const std::filesystem::path& folder, const EntryWords& words);

/// Flies every mission of a submission again into FOLDER, what was commanded, without running
/// anything of the file, and compares: the figures of the track where all tasks are flown. A line a
/// difference; none: it is what it says. `runs` gets the run directories, task by
/// task. Throws BadInput for a task to fly that there is not.
std::vector<std::string> verify_submission(const Submission& submission, const Suite& suite,
                                           const std::filesystem::path& folder,
                                           const SuiteFlights& flights,
                                           std::vector<std::filesystem::path>* runs = nullptr);

/// Throws BadInput for what verify_submission() would refuse before it flies.
void need_flyable(const Submission& submission, const Suite& suite);

/// Fills in what tasks of a track lack: workspace and start of random structures, hashes of meshes,
/// ceilings, and the best of the planners. The file is written by rename after each task, and what
/// is frozen stays. Missions lie in FOLDER and are not flown again.
void freeze_track(const std::filesystem::path& suite_file, const std::string& track,
                  const std::vector<std::string>& planners, const std::filesystem::path& folder,
                  const SuiteFlights& flights);

/// A panel a track that has entries: their scores with intervals, the best above. Throws as
/// standings() does.
Figure standings_figure(const Suite& suite, const std::vector<Submission>& entries);

/// Writes FOLDER/index.html with the standings, and FOLDER/missions/... with a page of each
/// mission, flown again from the submissions. Throws CommandFailed when one is not what it says.
void write_suite_page(const Suite& suite, const std::vector<Submission>& entries,
                      const std::filesystem::path& folder, const SuiteFlights& flights);

}  // namespace gnbv
