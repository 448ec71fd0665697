#include "tools/mission/rescore.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/score/cloud_faults.hpp"
#include "scenarios/load.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/stopwatch.hpp"
#include "tools/mission/load_world.hpp"
#include "tools/run_files/cloud_file.hpp"
#include "tools/run_files/iterations_csv.hpp"
#include "tools/run_files/summary_file.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

Scored score(const Scenario& scenario, const World& world, const RayScene& scene,
             const ScoredCloud& cloud, int threads) {
  const Stopwatch watch;
  const double floor_z_m = scenario.planner.floor_z_m;
  const SurfaceReference reference =
      cached_surface_reference(world, scene, {.floor_z_m = floor_z_m}, threads);
  const double reference_s = watch.elapsed_s();
  const MissionScore found =
      score_cloud(reference, scene, cloud, scenario.planner.map.resolution_m, threads);
  return {.score = found,
          .structure = structure_name(scenario.structure),
          .points = cloud.points_world_m.size(),
          .floor_z_m = floor_z_m,
          .reference_s = reference_s,
          .score_s = watch.elapsed_s() - reference_s};
}

World world_of(const Scenario& scenario) {
  std::vector<std::string> warnings;  // the mission told them
  return {.structure = load_structure(scenario, warnings), .has_ground = scenario.structure.ground};
}

/// What a score needs of summary.json.
struct SummaryPart {
  double profile_end_s = 0.0;
  std::size_t views = 0;
};

SummaryPart read_summary_part(const fs::path& run) {
  const auto summary = nlohmann::json::parse(read_summary(run), nullptr, false);
  const auto complain = [&](const char* what) {
    throw BadInput(fmt::format("{}: {}", (run / "summary.json").string(), what));
  };
  if (!summary.is_object()) complain("is no JSON object");
  if (!summary.contains("profile_end_s") || !summary.at("profile_end_s").is_number()) {
    complain("profile_end_s: is missing or no number");
  }
  if (!summary.contains("iterations") || !summary.at("iterations").is_number_unsigned()) {
    complain("iterations: is missing or no count");
  }
  return {summary.at("profile_end_s").get<double>(), summary.at("iterations").get<std::size_t>()};
}

/// Files of two runs in one directory would score as neither.
void need_matching(const fs::path& run, const ScoredCloud& cloud, std::span<const Vec3f> profile,
                   std::size_t views) {
  if (cloud.views.size() != views) {
    throw BadInput(fmt::format("{}: {} views, {} in summary.json: files of two runs?",
                               (run / "iterations.csv").string(), cloud.views.size(), views));
  }
  const std::span<const Vec3f> points = cloud.points_world_m;
  if (profile.size() > points.size() ||
      !std::equal(profile.begin(), profile.end(), points.begin())) {
    throw BadInput(fmt::format("{}: is not the beginning of cloud.ply: files of two runs?",
                               (run / "profile.ply").string()));
  }
  std::size_t before = profile.size();
  for (std::size_t view = 0; view < cloud.views.size(); ++view) {
    const std::size_t now = cloud.views[view].cloud_points;
    if (now < before || now > points.size()) {
      throw BadInput(
          fmt::format("{}:{}: cloud_points {} after {}, of {} in cloud.ply: files of "
                      "two runs?",
                      (run / "iterations.csv").string(), view + 2, now, before, points.size()));
    }
    before = now;
  }
}

}  // namespace

Scored score_any_cloud(const std::string& name, std::span<const Vec3f> cloud_world_m,
                       const Scenario& scenario, int threads) {
  const World world = world_of(scenario);
  const RayScene scene(world);
  const std::vector<Vec3f> points_m = scorable_points(
      name, cloud_world_m, scenario.planner.floor_z_m, scene, bounds_m(world.structure));
  Scored scored = score(scenario, world, scene, {.points_world_m = points_m}, threads);
  scored.points_below_floor = cloud_world_m.size() - points_m.size();
  return scored;
}

Scored score_run(const fs::path& run, int threads) {
  const SummaryPart summary = read_summary_part(run);
  const Scenario scenario = load_scenario((run / "scenario.yaml").string(), {});
  const fs::path cloud_path = run / "cloud.ply";
  const std::vector<Vec3f> points = read_cloud(cloud_path);
  need_voxels(cloud_path.string(), points);
  const std::vector<Vec3f> profile = read_cloud(run / "profile.ply");
  const ScoredCloud cloud{.points_world_m = points,
                          .profile_points = profile.size(),
                          .profile_end_s = summary.profile_end_s,
                          .views = read_view_marks(run / "iterations.csv")};
  need_matching(run, cloud, profile, summary.views);
  const World world = world_of(scenario);
  const RayScene scene(world);
  return score(scenario, world, scene, cloud, threads);
}

void update_run(const fs::path& run, const MissionScore& score) {
  const std::string summary =
      rescored_summary_json((run / "summary.json").string(), read_summary(run), score);
  write_file_atomically(run / "coverage.csv", coverage_csv(score.curve));
  write_file_atomically(run / "summary.json", summary);
}

}  // namespace gnbv
