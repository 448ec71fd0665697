#include "tools/run/run_directory.hpp"

#include <algorithm>

#include "planner/core/belief.hpp"
#include "planner/map/octomap_io.hpp"
#include "planner/planners.hpp"
#include "scenarios/load.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/run/cloud_file.hpp"
#include "tools/run/coverage_csv.hpp"
#include "tools/run/iterations_csv.hpp"
#include "tools/run/run_files.hpp"
#include "tools/run/summary_json.hpp"
#include "tools/run/tour_files.hpp"
#include "tools/run/trajectory_tum.hpp"
#include "tools/run/user_views.hpp"

namespace gnbv {

namespace fs = std::filesystem;

namespace {

constexpr const char* kOtherRecord =
    "another version of the program, another world or another kind of processor made the record, "
    "or it was edited";

/// Nothing is in the folder but what claims and killed writers leave; or it is not there.
bool holds_only_leftovers(const fs::path& folder) {
  std::error_code ignored;
  return std::all_of(fs::directory_iterator(folder, ignored), fs::directory_iterator(),
                     [](const fs::directory_entry& entry) {
                       return entry.path().filename() == kLockFile || is_temporary(entry.path());
                     });
}

/// Before any is flown again: a leg to nowhere takes for ever.
void need_inside(const ViewRecord& view, const Scenario& scenario, const fs::path& file) {
  constexpr double kRounding_m = 1e-6;
  std::vector<Vec3> places_m = view.decision.via_world_m;
  places_m.push_back(view.decision.view.p_world_m);
  for (const Vec3& p_m : places_m) {
    if (scenario.workspace_m.exteriorDistance(p_m) <= kRounding_m) continue;
    throw BadInput("{}:{}: view {} leads to {:g} {:g} {:g} m, outside the workspace: {}",
                   file.string(), view.iteration + 2, view.iteration, p_m.x(), p_m.y(), p_m.z(),
                   kOtherRecord);
  }
}

/// The summary of the folder; nothing when it has none that can be read.
std::optional<RunSummary> summary_of(const fs::path& folder) {
  try {
    return read_summary(folder);
  } catch (const BadInput&) {
    return std::nullopt;
  }
}

/// Whether the run in the folder, with the views that it was given on the way, is of the scenario.
bool is_run_of(const fs::path& folder, const Scenario& scenario) {
  const std::string yaml = (folder / kScenarioFile).string();
  if (is_written_in(yaml, scenario)) return true;
  Scenario before = scenario;
  Scenario flown = load_flown_scenario(yaml);
  const std::vector<MeshFileKey> now = mesh_files(before), then = mesh_files(flown);
  // what a mesh holds, inputs.json says: where it lies may be another place by now
  for (std::size_t i = 0; fs::exists(folder / kInputsFile) && i < now.size(); ++i) {
    if (now.size() != then.size() || now[i].file->path.empty()) continue;
    if (!then[i].file->path.empty()) now[i].file->path = then[i].file->path;
  }
  if (is_written_in(yaml, before)) return true;
  const std::vector<ViewPose>& views = scenario.planner.routes.views;
  if (views.empty() || given_rows(views_on_the_way(folder)) != given_rows(views)) return false;
  before.planner.routes.views = flown.planner.routes.views;
  return is_written_in(yaml, before);
}

}  // namespace

void need_usable(const fs::path& folder, const Scenario& scenario, bool resume) {
  std::error_code ignored;
  const bool holds_a_run = fs::exists(folder / kScenarioFile, ignored);
  if (!holds_a_run && !holds_only_leftovers(folder)) {
    throw BadInput("{}: is not empty and holds no run{}: choose another --out", folder.string(),
                   resume ? fmt::format(" to go on with (no {})", kScenarioFile) : "");
  }
  if (holds_a_run && !resume) {
    throw BadInput("{}: holds a run already: add --resume to continue it, or choose another --out",
                   folder.string());
  }
  if (holds_a_run && !is_run_of(folder, scenario)) {
    throw BadInput(
        "{}: the run there is of another configuration: only the same one can be resumed",
        (folder / kScenarioFile).string());
  }
}

RunDirectory::RunDirectory(fs::path folder, const Scenario& scenario, bool resume)
    : folder_(std::move(folder)), columns_(columns_of(scenario)), rows_(columns_) {
  need_usable(folder_, scenario, resume);
  make_folder(folder_);
  const RunFiles files(folder_);
  const bool holds_a_run = files.find(kScenarioFile).has_value();
  const std::optional<RunSummary> summary = holds_a_run ? summary_of(folder_) : std::nullopt;
  const std::optional<fs::path> record = holds_a_run ? files.find(kIterationsFile) : std::nullopt;
  if (record) {
    recorded_ = read_view_records(*record);
    if (summary) need_views_of_summary(*record, *summary, recorded_);
    for (const ViewRecord& view : recorded_) need_inside(view, scenario, *record);
  }
  if (summary && summary->termination && *summary->termination != "interrupted") {
    finished_sha256_ = summary->result_sha256.value_or("");
  }
  remove_stale_temporaries(folder_);
  remove_stale_temporaries(folder_ / kFramesFolder);
  // the journal is written anew as the recorded views are flown again, and takes its place only
  // when it has caught up: a resumed run that is killed, too, has lost nothing
  write_file_atomically(folder_ / kScenarioFile, to_yaml(scenario));
  fs::remove(part_of(folder_ / kViewsFile));
}

std::vector<Decision> RunDirectory::recorded_decisions() const {
  std::vector<Decision> decisions;
  for (const ViewRecord& view : recorded_) decisions.push_back(view.decision);
  return decisions;
}

void RunDirectory::need_as_recorded(const ViewRecord& view) const {
  const auto i = static_cast<std::size_t>(view.iteration);
  if (i >= recorded_.size()) return;
  const std::optional<Difference> difference = first_difference(view, recorded_[i]);
  if (!difference) return;
  throw BadInput(
      "{}: view {}: {} is {} when it is flown again, recorded was {}: {}; {} flies it anew",
      folder_.string(), i, difference->column, difference->now, difference->recorded, kOtherRecord,
      command_to_fly_again(folder_));
}

void RunDirectory::need_as_recorded(const MissionResult& result) const {
  const bool is_short = result.views.size() < recorded_.size();
  // who is given more views than before goes on from where the run had ended
  const bool is_other =
      !given_views_ && !finished_sha256_.empty() && result_sha256(result) != finished_sha256_;
  if (!is_short && !is_other) return;
  const std::string what =
      is_short ? fmt::format("flown again it ends after {} views ({}), recorded were {}",
                             result.views.size(), name_of(result.termination), recorded_.size())
               : "flown again it comes to another result than its summary.json holds";
  throw BadInput("{}: {}: {}; {} flies it anew", folder_.string(), what, kOtherRecord,
                 command_to_fly_again(folder_));
}

void RunDirectory::write_profile(const Belief& belief) const {
  write_belief(belief, folder_ / kProfileMapFile);
}

void RunDirectory::append(const ViewRecord& view) {
  if (!journal_ && static_cast<std::size_t>(view.iteration) + 1 < recorded_.size()) {
    pending_ += rows_.row(view);
    return;
  }
  if (!journal_) journal_.emplace(part_of(folder_ / kIterationsFile), rows_.header() + pending_);
  journal_->write(rows_.row(view));
}

void RunDirectory::keep(std::span<const ViewPose> views) {
  if (given_views_) return given_views_->write(given_rows(views.last(1)));
  given_views_.emplace(part_of(folder_ / kViewsFile),
                       fmt::format("{}{}", kGivenHeader, given_rows(views)));
}

void RunDirectory::finish(const Scenario& scenario, const MissionResult& result,
                          const MissionScore& score, double total_wall_s) {
  std::error_code ignored;
  // an old one would be taken for that of the new files, were this process killed among them
  if (fs::remove(folder_ / kSummaryFile, ignored)) sync_to_disk(folder_);
  write_file_atomically(folder_ / kScenarioFile, to_yaml(scenario));  // with views given on the way
  write_file_atomically(folder_ / kTrajectoryFile, trajectory_tum(result.trajectory));
  write_cloud_ply(result.profile_points_world_m, folder_ / kProfileCloudFile);
  write_cloud_ply(result.belief.cloud.points_world_m(), folder_ / kCloudFile);
  write_octomap(result.belief.grid, folder_ / kMapStem);
  const PlannerTraits planner = traits_of(scenario.planner);
  if (planner.takes_views) {
    write_file_atomically(folder_ / kViewsFile, user_views_csv(result.user_views));
  }
  if (const UserFunctionConfig* const own = user_function(scenario.planner.utility)) {
    write_file_atomically(folder_ / kUserUtilityFile, own->source);
  }
  if (planner.makes_tours) {
    write_file_atomically(folder_ / kPredictionsFile, predictions_csv(result.gain_outcomes));
    write_file_atomically(folder_ / kPlanFile, plan_jsonl(result.tour_plans));
  }
  write_file_atomically(folder_ / kCoverageFile, coverage_csv(score.curve, score.more));
  // as long as it is shorter than the journal, the files above are not taken for the run's
  write_file_atomically(folder_ / kIterationsFile, iterations_csv(result.views, columns_));
  // before the summary: killed after it, a finished run would keep its journals for ever
  for (const char* name : {kIterationsFile, kViewsFile}) {
    fs::remove(part_of(folder_ / name), ignored);
  }
  // whoever sees the summary after a power failure sees the rest, too
  if (fs::exists(folder_ / kFramesFolder, ignored)) sync_all_to_disk(folder_ / kFramesFolder);
  write_file_atomically(folder_ / kSummaryFile,
                        summary_json(scenario, result, score, total_wall_s));
}

}  // namespace gnbv
