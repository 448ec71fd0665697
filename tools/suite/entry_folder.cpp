#include <stdlib.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/sha256.hpp"
#include "tools/run/file_names.hpp"
#include "tools/run/iterations_csv.hpp"
#include "tools/run/summary_json.hpp"
#include "tools/suite/entry.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kEntryFile = "bench.json";
constexpr const char* kSuiteFile = "suite.yaml";

Json texts_of(const std::vector<Override>& settings) {
  Json texts = Json::array();
  for (const Override& set : settings) texts.push_back(set.text);
  return texts;
}

std::vector<Override> settings_of(const Json& texts) {
  std::vector<Override> settings;
  for (const Json& text : texts) settings.push_back({text.get<std::string>()});
  return settings;
}

std::string text_of(const EntryFolder& entry) {
  return Json{{"track", entry.track},
              {"name", entry.planner.name},
              {"kind", kEntryKindNames.at(static_cast<std::size_t>(entry.planner.kind))},
              {"settings", texts_of(entry.planner.settings)},
              {"asks", texts_of(entry.planner.asks)},
              {"run_arguments", entry.planner.run_arguments}}
             .dump(1, ' ', false, Json::error_handler_t::replace) +
         "\n";
}

/// Every tenth sample, one a second, with the line that says whose.
std::string thinned(const std::string& trajectory) {
  std::string some;
  std::size_t line = 0;
  for (std::size_t at = 0; at < trajectory.size(); ++line) {
    const std::size_t end = std::min(trajectory.find('\n', at), trajectory.size() - 1) + 1;
    if (line == 0 || line % 10 == 1) some += trajectory.substr(at, end - at);
    at = end;
  }
  return some;
}

}  // namespace

void claim_entry_folder(const fs::path& folder, const EntryFolder& entry, bool resume) {
  const fs::path file = folder / kEntryFile;
  const fs::path lock_file = folder / kLockFile;  // stays: by it a claim at work is known
  make_folder(folder);
  if (!fs::is_empty(folder) && !fs::exists(lock_file) && !fs::exists(file)) {
    throw BadInput("{}: is not empty and holds no entry: choose another -o", folder.string());
  }
  std::optional<FileLock> lock;
  while (!(lock = FileLock::take(lock_file))) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  if (fs::exists(file)) {
    const bool is_same = read_file(file) == text_of(entry) &&
                         read_file(folder / kSuiteFile) == suite_yaml(entry.suite);
    if (!is_same) {
      throw BadInput("{}: is of another planner, track or suite: choose another -o", file.string());
    }
    if (resume) return;
    throw BadInput("{}: holds this entry already: --resume goes on with it", folder.string());
  }
  write_file_atomically(folder / kSuiteFile, suite_yaml(entry.suite));
  write_file_atomically(file, text_of(entry));
}

EntryFolder read_entry_folder(const fs::path& folder) {
  const fs::path file = folder / kEntryFile;
  const fs::path yaml = folder / kSuiteFile;
  EntryFolder entry;
  try {
    const Json json = Json::parse(read_file(file));
    json.at("track").get_to(entry.track);
    json.at("name").get_to(entry.planner.name);
    entry.planner.kind =
        json.at("kind") == kEntryKindNames[1] ? EntryKind::views : EntryKind::planner;
    entry.planner.settings = settings_of(json.at("settings"));
    entry.planner.asks = settings_of(json.at("asks"));
    json.at("run_arguments").get_to(entry.planner.run_arguments);
  } catch (const Json::exception&) {
    throw BadInput("{}: is damaged: no folder of `gnbv bench run`", file.string());
  }
  entry.suite = read_suite(read_file(yaml), yaml.string());
  return entry;
}

ScratchFolder::ScratchFolder() {
  std::error_code error;
  fs::path within = fs::temp_directory_path(error);
  if (error) throw BadInput("TMPDIR: the folder for temporary files: {}", error.message());
  std::string path = (within / "gnbv-bench-XXXXXX").string();
  if (mkdtemp(path.data()) == nullptr) refuse_to_write(path, errno);
  path_ = path;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

double planning_s(const fs::path& run) {
  const std::vector<ViewRecord> views = read_view_records(run / kIterationsFile);
  double all_s = 0.0;
  for (const ViewRecord& view : views) {
    if (!(view.wall.plan_s >= 0.0)) {
      throw BadInput("{}: plan_s: value {}: expects a number, 0 or more",
                     (run / kIterationsFile).string(), view.wall.plan_s);
    }
    all_s += view.wall.plan_s;
  }
  return views.empty() ? 0.0 : all_s / static_cast<double>(views.size());
}

std::map<std::string, std::string> mission_records(const fs::path& run, EntryKind kind) {
  std::map<std::string, std::string> records = {
      {kRecordFile, read_file(run / kIterationsFile)},
      {kPathFile, thinned(read_file(run / kTrajectoryFile))},
      {kCurveFile, read_file(run / kCoverageFile)}};
  if (kind == EntryKind::views) records[kGivenFile] = read_file(run / kViewsFile);
  return records;
}

SubmittedMission mission_of_run(const fs::path& run, const SuiteTask& task, const SuiteTrack& track,
                                EntryKind kind) {
  const RunFigures figures = read_run_figures(run);
  if (figures.curve.accurate.empty()) throw BadInput("{}: has no accurate coverage", run.string());
  SubmittedMission mission{.figures = task_figures(figures, task, track.effort)};
  mission.figures.plan_s = planning_s(run);
  mission.trajectory_sha256 = sha256_of(read_file(run / kTrajectoryFile));
  for (const auto& [file, text] : mission_records(run, kind)) mission.files[file] = "";
  return mission;
}

}  // namespace gnbv
