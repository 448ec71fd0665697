#include "tools/run/run_record.hpp"

#include <algorithm>

#include "bench/score/cloud_faults.hpp"
#include "scenarios/load.hpp"
#include "sim/core/error.hpp"
#include "sim/core/text.hpp"
#include "tools/run/cloud_file.hpp"
#include "tools/run/iterations_csv.hpp"
#include "tools/run/run_files.hpp"
#include "tools/run/summary_json.hpp"
#include "tools/run/trajectory_tum.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

std::string command_to_finish(const fs::path& folder) {
  return command_to_resume(folder) + " ends the run";
}

std::string absence_of(const fs::path& file) {
  return fmt::format("{}: {}", file.string(),
                     fs::exists(file) ? "is of an earlier end of the run" : "is missing");
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

void read_views(const RunFiles& files, RunRecord& record) {
  if (const auto file = files.find(kIterationsFile)) {
    record.views = read_view_records(*file);
    for (const ViewRecord& view : record.views) {
      need_near_workspace(view.decision.view.p_world_m, record.scenario.workspace_m,
                          {*file, view.iteration + 2});
    }
    if (!record.goes_on) return;
  }
  record.missing.push_back(fmt::format("{}, {} views are in its journal; {}",
                                       absence_of(record.folder / kIterationsFile),
                                       record.views.size(), command_to_finish(record.folder)));
}

/// Throws BadInput when iterations.csv holds other views than the run ended with.
void need_views_of_run(const RunRecord& record, const fs::path& csv, const RunSummary& summary) {
  const auto ended_with = static_cast<std::size_t>(record.figures->iterations);
  if (record.views.size() == ended_with) return need_views_of_summary(csv, summary, record.views);
  throw BadInput(
      "{}: holds {} views, and the run of summary.json has {}: damaged, or files of two runs? {} "
      "flies it again",
      csv.string(), record.views.size(), ended_with, command_to_fly_again(record.folder));
}

void read_figures(const RunFiles& files, RunRecord& record) {
  const fs::path path = record.folder / kSummaryFile;
  if (!files.find(kSummaryFile)) {
    record.missing.push_back(
        fmt::format("{}; {}", absence_of(path), command_to_finish(record.folder)));
    return;
  }
  const RunSummary summary = read_summary(record.folder);
  record.profile_end_s = summary.profile_end_s;
  record.views_begin_s = summary.views_begin_s;
  const bool has_curve = files.find(kCoverageFile).has_value();
  if (summary.schema == kSummarySchema && has_curve) {
    record.figures = read_run_figures(record.folder);
    if (const auto csv = files.find(kIterationsFile)) need_views_of_run(record, *csv, summary);
    return;
  }
  record.missing.push_back(fmt::format(
      "{}; `gnbv score {} --update` scores the run anew",
      has_curve ? fmt::format("{}: is of another version", path.string())
                : fmt::format("{}: is missing", (record.folder / kCoverageFile).string()),
      shell_word(record.folder.string())));
}

constexpr double kHeld_s =
    0.1001;  // a period of the path's samples, and what their text rounds off

}  // namespace

RunRecord read_run(const fs::path& given) {
  if (given.empty()) throw BadInput("RUN: is empty (a variable of the shell without value?)");
  const fs::path folder = plain_folder(given);
  const fs::path yaml = folder / kScenarioFile;
  if (!fs::exists(yaml)) {
    throw BadInput(
        "{}: no run directory: scenario.yaml is missing; `gnbv run SCENARIO --out {}` makes one",
        folder.string(), shell_word(folder.string()));
  }
  const RunFiles files(folder);
  RunRecord record{
      .folder = folder, .scenario = load_flown_scenario(yaml.string()), .goes_on = files.goes_on()};
  if (const auto trajectory = files.find(kTrajectoryFile)) {
    record.path = read_trajectory_tum(*trajectory, record.scenario.workspace_m);
  } else {
    record.missing.push_back(
        fmt::format("{}; {}", absence_of(folder / kTrajectoryFile), command_to_finish(folder)));
  }
  read_views(files, record);
  read_figures(files, record);
  return record;
}

int RunCloud::view_of(std::size_t point) const {
  if (point < profile_points) return -1;
  return static_cast<int>(std::upper_bound(view_points.begin(), view_points.end(), point) -
                          view_points.begin());
}

RunCloud read_run_cloud(const RunRecord& record) {
  const RunFiles files(record.folder);
  for (const char* name : {kCloudFile, kProfileCloudFile}) {
    if (files.find(name)) continue;
    throw BadInput("{}; {}", absence_of(record.folder / name), command_to_finish(record.folder));
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
    throw BadInput("{}: {} points do not fit profile.ply and iterations.csv: files of two runs?",
                   (record.folder / kCloudFile).string(), cloud.points_world_m.size());
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
  const std::string label = utility_label(utility);
  return user_function(utility) != nullptr ? label : human_name(label);
}

std::string run_title(const RunRecord& record) {
  const PlannerConfig& planner = record.scenario.planner;
  const std::string title =
      fmt::format("{}, {}", scenario_title(record.scenario), utility_title(planner.utility));
  return planner.preset == PlannerConfig{}.preset ? title : title + ", " + planner.preset;
}

std::string run_detail(const RunRecord& record) {
  const std::optional<RunFigures>& figures = record.figures;
  std::string detail = counted(
      figures ? static_cast<std::size_t>(figures->iterations) : record.views.size(), "view");
  if (figures) {
    detail += fmt::format(", {} m straight from one to the next", grouped(figures->straight_m, 1));
  }
  if (!record.views.empty()) {
    detail += fmt::format(", {} m flown", grouped(record.views.back().flown_m, 1));
  }
  if (figures) {
    detail += fmt::format(", coverage {:.1f} % at 0.05 m", 100.0 * figures->coverage_final[0]);
  }
  return detail;
}

std::optional<Isometry> true_pose_at(const RunRecord& record, double time_s) {
  const auto after = std::lower_bound(
      record.path.begin(), record.path.end(), time_s,
      [](const TrajectorySample& sample, double t_s) { return sample.time_s < t_s; });
  if (after == record.path.end()) {
    const bool is_held = !record.path.empty() && time_s <= record.path.back().time_s + kHeld_s;
    return is_held ? std::optional(record.path.back().T_world_body) : std::nullopt;
  }
  if (after->time_s == time_s) return after->T_world_body;
  if (after == record.path.begin()) {
    return time_s >= after->time_s - kHeld_s ? std::optional(after->T_world_body) : std::nullopt;
  }
  const auto before = std::prev(after);
  const double share = (time_s - before->time_s) / (after->time_s - before->time_s);
  const Vec3 from = before->T_world_body.translation();
  const Vec3 to = after->T_world_body.translation();
  const Eigen::Quaterniond turn(before->T_world_body.linear());
  Isometry T_world_body = Isometry::Identity();
  T_world_body.translate(from + share * (to - from));
  T_world_body.rotate(turn.slerp(share, Eigen::Quaterniond(after->T_world_body.linear())));
  return T_world_body;
}

}  // namespace gnbv
