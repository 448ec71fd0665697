#include "tools/run_files/run_directory.hpp"

#include "planner/map/octomap_io.hpp"
#include "scenarios/load.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/shell_word.hpp"
#include "tools/run_files/cloud_file.hpp"
#include "tools/run_files/iterations_csv.hpp"
#include "tools/run_files/profile_map.hpp"
#include "tools/run_files/summary_file.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kScenario = "scenario.yaml";
constexpr std::string_view kIterations = "iterations.csv";
constexpr std::string_view kJournal = "iterations.csv.part";
constexpr std::string_view kCoverage = "coverage.csv";
constexpr std::string_view kSummary = "summary.json";

std::string trajectory_tum(const MissionResult& result) {
  std::string text = "# time_s x_m y_m z_m qx qy qz qw, body FLU in world ENU\n";
  for (const TrajectorySample& sample : result.trajectory) {
    const Vec3 p = sample.T_world_body.translation();
    const Eigen::Quaterniond q(sample.T_world_body.linear());
    text += fmt::format("{:.3f} {:.6f} {:.6f} {:.6f} {:.9f} {:.9f} {:.9f} {:.9f}\n", sample.time_s,
                        p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w());
  }
  return text;
}

}  // namespace

void need_usable(const fs::path& folder, const Scenario& scenario, bool resume) {
  std::error_code error;
  const bool holds_a_run = fs::exists(folder / kScenario, error);
  if (!holds_a_run && fs::exists(folder, error) && !fs::is_empty(folder, error)) {
    throw BadInput(
        fmt::format("{}: is not empty and holds no run: choose another --out", folder.string()));
  }
  if (holds_a_run && !resume) {
    throw BadInput(
        fmt::format("{}: holds a run already: add --resume to continue it, or choose "
                    "another --out",
                    folder.string()));
  }
  if (holds_a_run && read_file(folder / kScenario) != to_yaml(scenario)) {
    throw BadInput(
        fmt::format("{}: the run there is of another configuration: only the same one "
                    "can be resumed",
                    (folder / kScenario).string()));
  }
}

std::string command_to_resume(const fs::path& folder) {
  std::error_code ignored;
  const auto keeps = [&](const char* name) { return fs::exists(folder / name, ignored); };
  return fmt::format(
      "`gnbv run {} --resume --out {}{}{}`", shell_word((folder / kScenario).string()),
      shell_word(folder.string()), keeps("frames") ? " --frames" : "",
      keeps("candidates.jsonl") || keeps("candidates.jsonl.part") ? " --candidates" : "");
}

RunDirectory::RunDirectory(fs::path folder, const Scenario& scenario, bool resume)
    : folder_(std::move(folder)) {
  need_usable(folder_, scenario, resume);
  std::error_code error;
  const bool holds_a_run = fs::exists(folder_ / kScenario, error);
  fs::create_directories(folder_, error);
  if (error) {
    throw BadInput(
        fmt::format("{}: cannot make the folder: {}", folder_.string(), error.message()));
  }
  for (const std::string_view name : {kJournal, kIterations}) {
    if (holds_a_run && recorded_.empty() && fs::exists(folder_ / name)) {
      recorded_ = read_decisions(folder_ / name);
    }
  }
  // the journal is written anew as the recorded views are flown again, and takes its place only
  // when it has caught up: a resumed run that is killed, too, has lost nothing
  write_file_atomically(folder_ / kScenario, to_yaml(scenario));
}

void RunDirectory::write_profile(const Belief& belief) const {
  write_belief(belief, folder_ / "profile.map");
}

void RunDirectory::append(const ViewRecord& view) {
  if (!journal_.is_open() && static_cast<std::size_t>(view.iteration) + 1 < recorded_.size()) {
    pending_ += iterations_csv_row(view);
    return;
  }
  if (!journal_.is_open()) {
    write_file_atomically(folder_ / kJournal, iterations_csv_header() + pending_);
    journal_.open(folder_ / kJournal, std::ios::binary | std::ios::app);
  }
  journal_ << iterations_csv_row(view) << std::flush;
  if (!journal_) throw BadInput(fmt::format("{}: cannot write", (folder_ / kJournal).string()));
}

void RunDirectory::finish(const Scenario& scenario, const MissionResult& result,
                          const MissionScore& score, double total_wall_s) {
  std::string csv = iterations_csv_header();
  for (const ViewRecord& view : result.views) csv += iterations_csv_row(view);
  write_file_atomically(folder_ / "trajectory.tum", trajectory_tum(result));
  write_cloud_ply(result.profile_points_world_m, folder_ / "profile.ply");
  write_cloud_ply(result.belief.cloud.points_world_m(), folder_ / "cloud.ply");
  write_octomap(result.belief.grid, folder_ / "map");
  write_file_atomically(folder_ / kIterations, csv);
  write_file_atomically(folder_ / kCoverage, coverage_csv(score.curve));
  write_file_atomically(folder_ / kSummary, summary_json(scenario, result, score, total_wall_s));
  journal_.close();
  std::error_code ignored;
  fs::remove(folder_ / kJournal, ignored);
}

}  // namespace gnbv
