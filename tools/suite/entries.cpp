#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/utsname.h>

#include <algorithm>
#include <fstream>
#include <thread>

#include "bench/sources/source_ids.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/simd.hpp"
#include "tools/suite/suite_work.hpp"
#include "tools/terminal/say.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMeshes = "meshes";

/// "Processor, 8 threads, avx2, Linux 6.1": what planning times are of.
std::string this_machine() {
  std::string model = "unknown processor";
  std::ifstream cpus("/proc/cpuinfo");
  for (std::string line; std::getline(cpus, line);) {
    if (!line.starts_with("model name")) continue;
    model = line.substr(line.find(':') + 2);
    break;
  }
  utsname system{};
  uname(&system);
  return fmt::format("{}, {} threads, {}, {} {}", model, std::thread::hardware_concurrency(),
                     name_of(simd_level()), system.sysname, system.release);
}

/// A command hears of no earlier call: a mission that it left half flown begins anew.
void drop_half_flown(const fs::path& folder, const std::vector<Cell>& cells) {
  for (const Cell& cell : cells) {
    const CellFiles files = cell_files(folder, cell.id);
    if (!fs::exists(files.part)) continue;
    // held until it is gone: another process may begin the mission in this moment
    if (const auto lock = FileLock::take(files.lock)) fs::remove_all(files.part);
  }
}

}  // namespace

void fly_entry(const fs::path& folder, const EntryFolder& entry,
               const std::vector<SuiteTask>& tasks, const SuiteFlights& flights) {
  TaskScenarios scenarios(entry.suite, folder / kMeshes);
  const std::vector<Cell> cells = cells_of_entry(entry.suite, tasks, entry.planner, scenarios);
  const auto& arguments = entry.planner.run_arguments;
  if (!arguments.empty() && arguments.front() == "--views") drop_half_flown(folder, cells);
  const std::vector<CellOutcome> outcomes =
      run_cells(cells, {.folder = folder,
                        .jobs = flights.jobs,
                        .threads = flights.threads,
                        .retry_failed = true,
                        .quiet = flights.quiet,
                        .run_arguments = entry.planner.run_arguments});
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (outcomes[i].status == CellStatus::missing) {
      throw CommandFailed("interrupted; with --resume the same command goes on");
    }
    if (outcomes[i].status == CellStatus::failed) {
      throw CommandFailed("{}: {}; with --resume it is flown again", cells[i].scenario,
                          outcomes[i].failure);
    }
  }
}

Submission submission_of(const fs::path& folder, const EntryWords& words) {
  const EntryFolder entry = read_entry_folder(folder);
  const SuiteTrack& track = entry.suite.track(entry.track);
  const std::vector<SuiteTask> tasks = entry.suite.tasks_of(track.name);
  TaskScenarios scenarios(entry.suite, folder / kMeshes);
  const std::vector<Cell> cells = cells_of_entry(entry.suite, tasks, entry.planner, scenarios);
  Submission submission{.suite_version = entry.suite.version,
                        .track = track.name,
                        .track_sha256 = track_sha256(entry.suite, track.name),
                        .name = entry.planner.name,
                        .kind = entry.planner.kind,
                        .description = words.description,
                        .licence = words.licence,
                        .machine = this_machine(),
                        .program = GNBV_VERSION,
                        .program_sha256 = flying_source_id()};
  for (const Override& set : entry.planner.settings) submission.settings.push_back(set.text);
  std::vector<std::string> missing, loose;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const CellOutcome known = look_up(folder, cells[i]);
    if (!tasks[i].is_frozen()) loose.push_back(tasks[i].structure);
    if (known.status != CellStatus::done) missing.push_back(tasks[i].structure);
    if (!loose.empty() || !missing.empty()) continue;
    submission.missions.push_back(mission_of_run(known.run, tasks[i], track, submission.kind));
    for (auto& [file, text] : mission_records(known.run, submission.kind)) {
      submission.records[member_name(tasks[i].structure, file)] = std::move(text);
    }
  }
  if (!loose.empty()) {
    throw BadInput("track {}: not frozen yet, so that nothing can be submitted: {}", track.name,
                   fmt::join(loose, ", "));
  }
  if (!missing.empty()) {
    throw BadInput("{}: not flown by this program: {}; `gnbv bench run` with --resume flies them",
                   folder.string(), fmt::join(missing, ", "));
  }
  submission.figures = track_figures(entry.suite, submission.missions);
  return submission;
}

}  // namespace gnbv
