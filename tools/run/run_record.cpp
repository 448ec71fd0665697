#include "tools/run/run_record.hpp"

#include <algorithm>

#include "bench/score/cloud_faults.hpp"
#include "scenarios/load.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/text.hpp"
#include "tools/run/cloud_file.hpp"
#include "tools/run/file_names.hpp"
#include "tools/run/iterations_csv.hpp"
#include "tools/run/summary_json.hpp"
#include "tools/run/trajectory_tum.hpp"
#include "tools/run/words.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

std::string command_to_finish(const fs::path& folder) {
  return command_to_resume(folder) + " ends the run";
}

/// Without "./", "..", or a slash at its end; "." itself by its name.
fs::path plain_folder(const fs::path& given) {
  const auto normal = [](const fs::path& path) {
    const fs::path plain = path.lexically_normal();
    return plain.has_filename() ? plain : plain.parent_path();
  };
  const fs::path plain = normal(given);
  const bool is_nameless = plain.empty() || plain == "." || plain.filename() == "..";
  return is_nameless ? normal(fs::absolute(given)) : plain;
}

void read_views(RunRecord& record) {
  const fs::path csv = record.folder / kIterationsFile;
  const fs::path journal = part_of(csv);
  const fs::path& file = fs::exists(csv) ? csv : journal;
  if (fs::exists(file)) record.views = read_view_records(file);
  for (const ViewRecord& view : record.views) {
    need_near_workspace(view.decision.view.p_world_m, record.scenario.workspace_m,
                        {file, view.iteration + 2});
  }
  if (fs::exists(csv)) return;
  record.missing.push_back(fmt::format("{}: is missing, {} views are in its journal; {}",
                                       csv.string(), record.views.size(),
                                       command_to_finish(record.folder)));
}

/// Throws BadInput when iterations.csv holds fewer or more views than the run ended with.
void need_all_views(const RunRecord& record) {
  const fs::path csv = record.folder / kIterationsFile;
  const auto ended_with = static_cast<std::size_t>(record.figures->iterations);
  if (record.views.size() == ended_with || !fs::exists(csv)) return;
  throw BadInput(fmt::format(
      "{}: holds {} views, and the run of summary.json has {}: damaged, or "
      "files of two runs? {} flies it again",
      csv.string(), record.views.size(), ended_with, command_to_fly_again(record.folder)));
}

/// As long as there is an iterations.csv: the journal of a run that goes on is ahead of an old
/// summary.
void need_views_of(const RunRecord& record, const RunSummary& summary) {
  const fs::path csv = record.folder / kIterationsFile;
  if (fs::exists(csv)) need_views_of_summary(csv, summary, record.views);
}

void read_figures(RunRecord& record) {
  const fs::path path = record.folder / kSummaryFile;
  if (!fs::exists(path)) {
    record.missing.push_back(
        fmt::format("{}: is missing; {}", path.string(), command_to_finish(record.folder)));
    return;
  }
  const RunSummary summary = read_summary(record.folder);
  record.profile_end_s = summary.profile_end_s;
  record.views_begin_s = summary.views_begin_s;
  const fs::path curve = record.folder / kCoverageFile;
  if (summary.schema == kSummarySchema && fs::exists(curve)) {
    record.figures = read_run_figures(record.folder);
    need_all_views(record);
    need_views_of(record, summary);
    return;
  }
  record.missing.push_back(fmt::format("{}; `gnbv score {} --update` scores the run anew",
                                       fs::exists(curve)
                                           ? fmt::format("{}: is of another version", path.string())
                                           : fmt::format("{}: is missing", curve.string()),
                                       shell_word(record.folder.string())));
}

}  // namespace

RunRecord read_run(const fs::path& given) {
  if (given.empty()) throw BadInput("RUN: is empty (a variable of the shell without value?)");
  const fs::path folder = plain_folder(given);
  const fs::path yaml = folder / kScenarioFile;
  if (!fs::exists(yaml)) {
    throw BadInput(
        fmt::format("{}: no run directory: scenario.yaml is missing; `gnbv run SCENARIO --out {}` "
                    "makes one",
                    folder.string(), shell_word(folder.string())));
  }
  RunRecord record{.folder = folder, .scenario = load_flown_scenario(yaml.string())};
  const fs::path trajectory = folder / kTrajectoryFile;
  if (fs::exists(trajectory)) {
    record.path = read_trajectory_tum(trajectory, record.scenario.workspace_m);
  } else {
    record.missing.push_back(
        fmt::format("{}: is missing; {}", trajectory.string(), command_to_finish(folder)));
  }
  read_views(record);
  read_figures(record);
  return record;
}

int RunCloud::view_of(std::size_t point) const {
  if (point < profile_points) return -1;
  return static_cast<int>(std::upper_bound(view_points.begin(), view_points.end(), point) -
                          view_points.begin());
}

RunCloud read_run_cloud(const RunRecord& record) {
  for (const char* name : {kCloudFile, kProfileCloudFile}) {
    const fs::path path = record.folder / name;
    if (fs::exists(path)) continue;
    throw BadInput(
        fmt::format("{}: is missing; {}", path.string(), command_to_finish(record.folder)));
  }
  RunCloud cloud{.points_world_m = read_cloud(record.folder / kCloudFile),
                 .profile_points = read_cloud(record.folder / kProfileCloudFile).size(),
                 .view_points = {}};
  need_voxels((record.folder / kCloudFile).string(), cloud.points_world_m,
              std::min(kCoverageSizes_m[0], record.scenario.planner.map.resolution_m));
  std::size_t before = cloud.profile_points;
  for (const ViewRecord& view : record.views) {
    if (view.cloud_points < before) break;
    before = view.cloud_points;
    cloud.view_points.push_back(before);
  }
  // a run that ends in flight has points that came after its last view
  if (cloud.view_points.size() != record.views.size() || before > cloud.points_world_m.size()) {
    throw BadInput(
        fmt::format("{}: {} points do not fit profile.ply and iterations.csv: files of "
                    "two runs?",
                    (record.folder / kCloudFile).string(), cloud.points_world_m.size()));
  }
  return cloud;
}

std::string scenario_title(const Scenario& scenario) {
  const std::string name = human_name(scenario.name);
  if (is_builtin(scenario.structure)) return name;
  const fs::path mesh(structure_name(scenario.structure));
  return fmt::format("{} ({})", name, mesh.filename().string());
}

std::string utility_title(const UtilityConfig& utility) {
  return is_user_utility(utility.name) ? utility.python.function : human_name(utility.name);
}

std::string run_title(const RunRecord& record) {
  const PlannerConfig& planner = record.scenario.planner;
  const std::string title =
      fmt::format("{}, {}", scenario_title(record.scenario), utility_title(planner.utility));
  return planner.preset == PlannerConfig{}.preset ? title : title + ", " + planner.preset;
}

std::string run_detail(const RunRecord& record) {
  const auto views =
      record.figures ? static_cast<std::size_t>(record.figures->iterations) : record.views.size();
  std::string detail = counted(views, "view");
  if (record.figures)
    detail +=
        fmt::format(", {} m straight from one to the next", grouped(record.figures->straight_m, 1));
  if (!record.views.empty())
    detail += fmt::format(", {} m flown", grouped(record.views.back().flown_m, 1));
  if (record.figures) {
    detail +=
        fmt::format(", coverage {:.1f} % at 0.05 m", 100.0 * record.figures->coverage_final[0]);
  }
  return detail;
}

}  // namespace gnbv
