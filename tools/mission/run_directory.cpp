#include "tools/mission/run_directory.hpp"

#include <nlohmann/json.hpp>

#include "planner/belief_file.hpp"
#include "planner/map/octomap_io.hpp"
#include "scenarios/load.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/mission/cloud_file.hpp"
#include "tools/mission/iterations_csv.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr std::string_view kScenario = "scenario.yaml";
constexpr std::string_view kIterations = "iterations.csv";
constexpr std::string_view kJournal = "iterations.csv.part";
constexpr std::string_view kSummary = "summary.json";

Json by_size(const std::array<double, 3>& coverage) {
  return {{"0.05", coverage[0]}, {"0.10", coverage[1]}, {"0.50", coverage[2]}};
}

Json symmetry_of(const Prediction& prediction) {
  const Symmetry& symmetry = prediction.symmetry;
  Json plane = nullptr;
  if (symmetry.plane) {
    const Vec3& n = symmetry.plane->normal_world;
    plane = {{"normal", std::vector<double>(n.begin(), n.end())},
             {"offset_m", symmetry.plane->offset_m}};
  }
  return {{"plane", plane},
          {"support", symmetry.support},
          {"confirmed", symmetry.confirmed},
          {"predicted_voxels", prediction.predicted_voxels}};
}

Json summary(const Scenario& scenario, const MissionResult& r, const MissionScore& score,
             double total_wall_s) {
  const double entropy_nat = r.belief.grid.total_entropy_nat();
  const double battery_wh = scenario.vehicle.power.battery_wh;
  const Json battery = battery_wh > 0.0 ? Json(battery_wh) : Json(nullptr);  // null: never empty
  const Vec3 p = r.final_state.T_world_body.translation();
  const Eigen::Quaterniond q(r.final_state.T_world_body.linear());
  const Vec3& v = r.final_state.v_world_m_s;
  return {
      {"schema", 1},
      {"scenario", scenario.name},
      {"structure", scenario.structure.file.path.empty() ? scenario.structure.builtin
                                                         : scenario.structure.file.path},
      {"utility", scenario.planner.utility.name},
      {"preset", scenario.planner.preset},
      {"vehicle", scenario.vehicle.kind == VehicleKind::ideal ? "ideal" : scenario.vehicle.preset},
      {"seed", scenario.seed},
      {"version", GNBV_VERSION},
      {"iterations", r.views.size()},
      {"termination", name_of(r.termination)},
      {"distance_m",
       {{"straight", r.distance.straight_m},
        {"flown", r.distance.flown_m},
        {"profile", r.distance.profile_m},
        {"profile_flown", r.distance.profile_flown_m},
        {"transfer", r.distance.transfer_m}}},
      {"profile_end_s", r.profile_end_s},
      {"views_begin_s", r.views.empty() ? r.profile_end_s : r.views.front().time_s},
      {"flight_time_s", r.flight_time_s},
      {"energy_wh", r.energy_wh},
      {"battery_wh", battery},
      {"entropy_nat",
       {{"after_profile", r.entropy_after_profile_nat},
        {"final", entropy_nat},
        {"reduction", r.entropy_after_profile_nat - entropy_nat}}},
      {"symmetry", symmetry_of(r.prediction)},
      {"coverage",
       {{"profile", by_size(score.profile)},
        {"final", by_size(score.final)},
        {"profile_raw_reference", by_size(score.profile_raw)},
        {"final_raw_reference", by_size(score.final_raw)}}},
      {"density_points_per_voxel", r.views.empty() ? 0.0 : r.views.back().density_points_per_voxel},
      {"collisions", r.termination == Termination::collision ? 1 : 0},
      {"legs_timed_out", r.legs_timed_out},
      {"final_state",
       {{"position_m", std::vector<double>(p.begin(), p.end())},
        {"quaternion_xyzw", std::vector<double>{q.x(), q.y(), q.z(), q.w()}},
        {"velocity_m_s", std::vector<double>(v.begin(), v.end())}}},
      {"wall_s",
       {{"total", total_wall_s},
        {"profile", r.wall.profile_s},
        {"symmetry", r.wall.symmetry_s},
        {"sense", r.wall.sense_s},
        {"map", r.wall.map_s},
        {"plan", r.wall.plan_s},
        {"fly", r.wall.fly_s},
        {"score", r.wall.score_s}}},
      {"result_sha256", result_sha256(r)},
  };
}

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

RunDirectory::RunDirectory(fs::path folder, const Scenario& scenario, bool resume)
    : folder_(std::move(folder)) {
  const std::string yaml = to_yaml(scenario);
  std::error_code error;
  const bool holds_a_run = fs::exists(folder_ / kScenario, error);
  if (!holds_a_run && fs::exists(folder_, error) && !fs::is_empty(folder_, error)) {
    throw BadInput(
        fmt::format("{}: is not empty and holds no run: choose another --out", folder_.string()));
  }
  if (holds_a_run && !resume) {
    throw BadInput(
        fmt::format("{}: holds a run already: add --resume to continue it, or choose "
                    "another --out",
                    folder_.string()));
  }
  if (holds_a_run && read_file(folder_ / kScenario) != yaml) {
    throw BadInput(
        fmt::format("{}: the run there is of another configuration: only the same one "
                    "can be resumed",
                    (folder_ / kScenario).string()));
  }
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
  write_file_atomically(folder_ / kScenario, yaml);
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
  write_file_atomically(folder_ / kSummary,
                        summary(scenario, result, score, total_wall_s).dump(2) + "\n");
  journal_.close();
  std::error_code ignored;
  fs::remove(folder_ / kJournal, ignored);
}

}  // namespace gnbv
