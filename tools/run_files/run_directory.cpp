#include "tools/run_files/run_directory.hpp"

#include "planner/map/octomap_io.hpp"
#include "planner/tour_planner.hpp"
#include "scenarios/load.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/run_files/cloud_file.hpp"
#include "tools/run_files/coverage_csv.hpp"
#include "tools/run_files/file_names.hpp"
#include "tools/run_files/given_views.hpp"
#include "tools/run_files/iterations_csv.hpp"
#include "tools/run_files/plan_jsonl.hpp"
#include "tools/run_files/predictions_csv.hpp"
#include "tools/run_files/profile_map.hpp"
#include "tools/run_files/summary_json.hpp"
#include "tools/run_files/trajectory_tum.hpp"

namespace gnbv {

namespace fs = std::filesystem;

void need_usable(const fs::path& folder, const Scenario& scenario, bool resume) {
  std::error_code error;
  const bool holds_a_run = fs::exists(folder / kScenarioFile, error);
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
  if (holds_a_run && read_file(folder / kScenarioFile) != to_yaml(scenario)) {
    throw BadInput(
        fmt::format("{}: the run there is of another configuration: only the same one "
                    "can be resumed",
                    (folder / kScenarioFile).string()));
  }
}

RunDirectory::RunDirectory(fs::path folder, const Scenario& scenario, bool resume)
    : folder_(std::move(folder)), columns_(columns_of(scenario)) {
  need_usable(folder_, scenario, resume);
  std::error_code error;
  const bool holds_a_run = fs::exists(folder_ / kScenarioFile, error);
  make_folder(folder_);
  for (const fs::path& file : {journal_file(), folder_ / kIterationsFile}) {
    if (holds_a_run && recorded_.empty() && fs::exists(file)) recorded_ = read_decisions(file);
  }
  // the journal is written anew as the recorded views are flown again, and takes its place only
  // when it has caught up: a resumed run that is killed, too, has lost nothing
  write_file_atomically(folder_ / kScenarioFile, to_yaml(scenario));
}

fs::path RunDirectory::journal_file() const { return part_of(folder_ / kIterationsFile); }

void RunDirectory::write_profile(const Belief& belief) const {
  write_belief(belief, folder_ / kProfileMapFile);
}

void RunDirectory::append(const ViewRecord& view) {
  if (!journal_.is_open() && static_cast<std::size_t>(view.iteration) + 1 < recorded_.size()) {
    pending_ += iterations_csv_row(view, columns_);
    return;
  }
  if (!journal_.is_open()) {
    write_file_atomically(journal_file(), iterations_csv_header(columns_) + pending_);
    journal_.open(journal_file(), std::ios::binary | std::ios::app);
  }
  journal_ << iterations_csv_row(view, columns_) << std::flush;
  if (!journal_) throw BadInput(fmt::format("{}: cannot write", journal_file().string()));
}

void RunDirectory::keep(const Scenario& scenario) const {
  write_file_atomically(folder_ / kScenarioFile, to_yaml(scenario));
}

void RunDirectory::finish(const Scenario& scenario, const MissionResult& result,
                          const MissionScore& score, double total_wall_s) {
  write_file_atomically(folder_ / kTrajectoryFile, trajectory_tum(result.trajectory));
  write_cloud_ply(result.profile_points_world_m, folder_ / kProfileCloudFile);
  write_cloud_ply(result.belief.cloud.points_world_m(), folder_ / kCloudFile);
  write_octomap(result.belief.grid, folder_ / kMapStem);
  write_file_atomically(folder_ / kIterationsFile, iterations_csv(result.views, columns_));
  if (is_given_route(scenario.planner.utility.name)) {
    write_file_atomically(folder_ / kViewsFile, given_views_csv(result.given_views));
  }
  if (is_own_utility(scenario.planner.utility.name)) {
    write_file_atomically(folder_ / kOwnUtilityFile, scenario.planner.utility.python.source);
  }
  if (is_tour(scenario.planner.utility.name)) {
    write_file_atomically(folder_ / kPredictionsFile, predictions_csv(result.look_outcomes));
    write_file_atomically(folder_ / kPlanFile, plan_jsonl(result.tour_plans));
  }
  write_file_atomically(folder_ / kCoverageFile, coverage_csv(score.curve, score.more));
  write_file_atomically(folder_ / kSummaryFile,
                        summary_json(scenario, result, score, total_wall_s));
  journal_.close();
  std::error_code ignored;
  fs::remove(journal_file(), ignored);
}

}  // namespace gnbv
