#include "tools/mission/rescore.hpp"

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "bench/cloud_faults.hpp"
#include "scenarios/load.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/mission/cloud_file.hpp"
#include "tools/mission/iterations_csv.hpp"
#include "tools/mission/load_world.hpp"
#include "tools/mission/summary_file.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

Scored score(const Scenario& scenario, const World& world, const RayScene& scene,
             const ScoredCloud& cloud, int threads) {
  const auto begin = Clock::now();
  const double floor_z_m = scenario.planner.floor_z_m;
  const SurfaceReference reference =
      cached_surface_reference(world, scene, {.floor_z_m = floor_z_m}, threads);
  const auto scoring = Clock::now();
  const MissionScore found =
      score_cloud(reference, scene, cloud, scenario.planner.map.resolution_m, threads);
  const StructureConfig& structure = scenario.structure;
  return {.score = found,
          .structure = structure.file.path.empty() ? structure.builtin : structure.file.path,
          .points = cloud.points_world_m.size(),
          .floor_z_m = floor_z_m,
          .reference_s = std::chrono::duration<double>(scoring - begin).count(),
          .score_s = seconds_since(scoring)};
}

World world_of(const Scenario& scenario) {
  std::vector<std::string> warnings;  // the mission told them
  return {.structure = load_structure(scenario, warnings), .has_ground = scenario.structure.ground};
}

/// When the profile ended; a number of summary.json.
double profile_end_s(const fs::path& run) {
  const auto summary = nlohmann::json::parse(read_summary(run), nullptr, false);
  const bool has_it = summary.is_object() && summary.contains("profile_end_s") &&
                      summary.at("profile_end_s").is_number();
  if (has_it) return summary.at("profile_end_s").get<double>();
  throw BadInput(
      fmt::format("{}: profile_end_s: is missing or no number", (run / "summary.json").string()));
}

/// Files of two runs in one directory would score as neither.
void need_matching(const fs::path& run, const ScoredCloud& cloud, std::span<const Vec3f> profile) {
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
  const Box3 structure_m = bounds_m(world.structure);
  need_scorable(name, cloud_world_m, structure_m);
  const RayScene scene(world);
  const ScoredCloud cloud{.points_world_m = cloud_world_m};
  Scored scored = score(scenario, world, scene, cloud, threads);
  need_near(name, cloud_world_m, scored.score.distances, structure_m);
  return scored;
}

Scored score_run(const fs::path& run, int threads) {
  const double end_s = profile_end_s(run);
  const Scenario scenario = load_scenario((run / "scenario.yaml").string(), {});
  const std::vector<Vec3f> points = read_cloud(run / "cloud.ply");
  const std::vector<Vec3f> profile = read_cloud(run / "profile.ply");
  const ScoredCloud cloud{.points_world_m = points,
                          .profile_points = profile.size(),
                          .profile_end_s = end_s,
                          .views = read_view_marks(run / "iterations.csv")};
  need_matching(run, cloud, profile);
  const World world = world_of(scenario);
  const RayScene scene(world);
  return score(scenario, world, scene, cloud, threads);
}

void update_run(const fs::path& run, const MissionScore& score) {
  const std::string summary = rescored_summary_json(read_summary(run), score);
  write_file_atomically(run / "coverage.csv", coverage_csv(score.curve));
  write_file_atomically(run / "summary.json", summary);
}

}  // namespace gnbv
