#include "tools/run_files/run_record.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "bench/score/cloud_faults.hpp"
#include "scenarios/load.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/shell_word.hpp"
#include "tools/run_files/cloud_file.hpp"
#include "tools/run_files/iterations_csv.hpp"
#include "tools/run_files/run_directory.hpp"
#include "tools/run_files/run_figures_file.hpp"
#include "tools/run_files/separated_text.hpp"
#include "tools/run_files/summary_file.hpp"

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

/// Throws BadInput for a place that no vehicle of this scenario can have been at: farther from the
/// workspace than that is wide, which no drift of an estimate explains.
void need_near_workspace(const Vec3& p_world_m, const Box3& workspace_m, const TextPlace& place) {
  if (workspace_m.exteriorDistance(p_world_m) < workspace_m.diagonal().norm()) return;
  throw BadInput(fmt::format("{}: stands at {:g} {:g} {:g} m, far out of the workspace",
                             to_string(place), p_world_m.x(), p_world_m.y(), p_world_m.z()));
}

std::vector<TrajectorySample> read_path(const fs::path& path, const Box3& workspace_m) {
  const std::string text = read_file(path);
  std::string_view rest = text;
  std::vector<TrajectorySample> samples;
  for (int line = 1; !rest.empty(); ++line) {
    std::string_view row = trimmed(next_part(rest, '\n'));
    if (row.empty() || row.front() == '#') continue;
    const TextPlace place{path, line};
    std::array<double, 8> values{};  // time x y z qx qy qz qw
    for (double& value : values) {
      if (row.empty()) throw BadInput(fmt::format("{}: fewer than 8 values", to_string(place)));
      value = to_number(next_part(row, ' '), place, "one of the 8 values");
      row = trimmed(row);
    }
    if (!row.empty()) throw BadInput(fmt::format("{}: more than 8 values", to_string(place)));
    if (!samples.empty() && values[0] < samples.back().time_s) {
      throw BadInput(fmt::format("{}: time {} s goes back", to_string(place), values[0]));
    }
    const Eigen::Quaterniond q(values[7], values[4], values[5], values[6]);
    if (std::abs(q.norm() - 1.0) > 1e-3) {
      throw BadInput(fmt::format("{}: qx qy qz qw are no unit quaternion", to_string(place)));
    }
    TrajectorySample sample{.time_s = values[0]};
    sample.T_world_body.translate(Vec3(values[1], values[2], values[3]));
    need_near_workspace(sample.T_world_body.translation(), workspace_m, place);
    sample.T_world_body.rotate(q.normalized());
    samples.push_back(sample);
  }
  if (samples.empty()) throw BadInput(fmt::format("{}: holds no pose", path.string()));
  return samples;
}

void read_views(RunRecord& record) {
  const fs::path csv = record.folder / "iterations.csv";
  const fs::path journal = record.folder / "iterations.csv.part";
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
  const fs::path csv = record.folder / "iterations.csv";
  const auto ended_with = static_cast<std::size_t>(record.figures->iterations);
  if (record.views.size() == ended_with || !fs::exists(csv)) return;
  throw BadInput(fmt::format(
      "{}: holds {} views, and the run of summary.json has {}: damaged, or "
      "files of two runs? {} flies it again",
      csv.string(), record.views.size(), ended_with, command_to_fly_again(record.folder, "")));
}

void read_figures(RunRecord& record) {
  const fs::path path = record.folder / "summary.json";
  if (!fs::exists(path)) {
    record.missing.push_back(
        fmt::format("{}: is missing; {}", path.string(), command_to_finish(record.folder)));
    return;
  }
  try {
    const nlohmann::json summary = nlohmann::json::parse(read_file(path));
    const auto time_of = [&](const char* key) -> std::optional<double> {
      if (!summary.contains(key)) return std::nullopt;
      return summary.at(key).get<double>();
    };
    record.profile_end_s = time_of("profile_end_s");
    record.views_begin_s = time_of("views_begin_s");
    if (summary.at("schema").get<unsigned>() == kSummarySchema &&
        fs::exists(record.folder / "coverage.csv")) {
      record.figures = read_run_figures(record.folder);
      need_all_views(record);
      return;
    }
  } catch (const nlohmann::json::exception& error) {
    throw BadInput(fmt::format("{}: {}", path.string(), error.what()));
  }
  const fs::path curve = record.folder / "coverage.csv";
  record.missing.push_back(fmt::format("{}; `gnbv score {} --update` scores the run anew",
                                       fs::exists(curve)
                                           ? fmt::format("{}: is of another version", path.string())
                                           : fmt::format("{}: is missing", curve.string()),
                                       shell_word(record.folder.string())));
}

}  // namespace

RunRecord read_run(const fs::path& given) {
  if (given.empty()) throw BadInput("RUN is an empty name: a variable of the shell without value?");
  const fs::path folder = plain_folder(given);
  const fs::path yaml = folder / "scenario.yaml";
  if (!fs::exists(yaml)) {
    throw BadInput(
        fmt::format("{}: no run directory: scenario.yaml is missing; `gnbv run SCENARIO --out {}` "
                    "makes one",
                    folder.string(), shell_word(folder.string())));
  }
  RunRecord record{.folder = folder, .scenario = load_flown_scenario(yaml.string())};
  const fs::path trajectory = folder / "trajectory.tum";
  if (fs::exists(trajectory)) {
    record.path = read_path(trajectory, record.scenario.workspace_m);
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
  for (const char* name : {"cloud.ply", "profile.ply"}) {
    const fs::path path = record.folder / name;
    if (fs::exists(path)) continue;
    throw BadInput(
        fmt::format("{}: is missing; {}", path.string(), command_to_finish(record.folder)));
  }
  RunCloud cloud{.points_world_m = read_cloud(record.folder / "cloud.ply"),
                 .profile_points = read_cloud(record.folder / "profile.ply").size(),
                 .view_points = {}};
  need_voxels((record.folder / "cloud.ply").string(), cloud.points_world_m);
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
                    (record.folder / "cloud.ply").string(), cloud.points_world_m.size()));
  }
  return cloud;
}

std::string run_title(const RunRecord& record) {
  const PlannerConfig& planner = record.scenario.planner;
  const std::string title = fmt::format("{}, {}", record.scenario.name, planner.utility.name);
  return planner.preset == PlannerConfig{}.preset ? title : title + ", " + planner.preset;
}

std::string run_detail(const RunRecord& record) {
  const auto views =
      record.figures ? static_cast<std::size_t>(record.figures->iterations) : record.views.size();
  std::string detail = fmt::format("{} view{}", views, views == 1 ? "" : "s");
  if (!record.views.empty()) {
    detail += fmt::format(", {:.1f} m", record.views.back().flown_m);
  }
  if (record.figures) {
    detail +=
        fmt::format(", coverage {:.1f} % at 0.05 m", 100.0 * record.figures->coverage_final[0]);
  }
  return detail;
}

std::string command_to_fly_again(const fs::path& folder, const std::string& options) {
  return fmt::format("`gnbv run {} {}--out NEW`", shell_word((folder / "scenario.yaml").string()),
                     options.empty() ? "" : options + " ");
}

}  // namespace gnbv
