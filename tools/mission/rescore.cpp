#include "tools/mission/rescore.hpp"

#include <algorithm>

#include "bench/score/cloud_faults.hpp"
#include "scenarios/load.hpp"
#include "sim/core/error.hpp"
#include "sim/core/stopwatch.hpp"
#include "sim/core/text.hpp"
#include "tools/mission/load_world.hpp"
#include "tools/run/cloud_file.hpp"
#include "tools/run/file_names.hpp"
#include "tools/run/iterations_csv.hpp"
#include "tools/run/run_inputs.hpp"
#include "tools/run/summary_json.hpp"
#include "tools/terminal/progress.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

/// By a scenario whose region is the wish's box, if it has one.
Scored score(Scenario scenario, const World& world, const RayScene& scene, ScoredCloud cloud,
             const ScoreWish& wish, int threads) {
  const Stopwatch watch;
  if (wish.box_m) scenario.score.region_m = *wish.box_m;
  if (!wish.sizes_m.empty()) scenario.score.sizes_m = wish.sizes_m;
  need_room_for(scenario.score.sizes_m, world.structure);
  ProgressBar bar("score", wish.is_quiet);
  bar.show(0.0, "finding what there is to see");
  const SurfaceReference reference = reference_of(
      scenario, world, scene, threads, [&](const std::string& note) { bar.show(0.0, note); });
  const double reference_s = watch.elapsed_s();
  bar.show(0.2, fmt::format("comparing {} points", grouped(cloud.points_world_m.size())));
  const std::size_t points = cloud.points_world_m.size();
  Scored scored{
      .score = score_as_asked(scenario, world, scene, reference, std::move(cloud), threads),
      .sizes_m = scenario.score.sizes_m,
      .structure = structure_name(scenario.structure),
      .points = points,
      .floor_z_m = scenario.planner.floor_z_m,
      .reference_s = reference_s};
  scored.score_s = watch.elapsed_s() - reference_s;
  return scored;
}

/// Of those that score() counts the points by.
double smallest_voxel_m(const Scenario& scenario, const ScoreWish& wish) {
  double smallest_m = std::min(kCoverageSizes_m[0], scenario.planner.map.resolution_m);
  for (const double size_m : wish.sizes_m.empty() ? scenario.score.sizes_m : wish.sizes_m) {
    smallest_m = std::min(smallest_m, size_m);
  }
  return smallest_m;
}

/// Files of two runs in one directory would score as neither.
void need_matching(const fs::path& run, const ScoredCloud& cloud, std::span<const Vec3f> profile,
                   std::size_t views) {
  if (cloud.views.size() != views) {
    throw BadInput("{}: {} views, {} in summary.json: files of two runs?",
                   (run / kIterationsFile).string(), cloud.views.size(), views);
  }
  const std::span<const Vec3f> points = cloud.points_world_m;
  if (profile.size() > points.size() ||
      !std::equal(profile.begin(), profile.end(), points.begin())) {
    throw BadInput("{}: is not the beginning of cloud.ply: files of two runs?",
                   (run / kProfileCloudFile).string());
  }
  std::size_t before = profile.size();
  for (std::size_t view = 0; view < cloud.views.size(); ++view) {
    const std::size_t now = cloud.views[view].cloud_points;
    if (now < before || now > points.size()) {
      throw BadInput("{}:{}: cloud_points {} after {}, of {} in cloud.ply: files of two runs?",
                     (run / kIterationsFile).string(), view + 2, now, before, points.size());
    }
    before = now;
  }
}

}  // namespace

Scored score_any_cloud(const std::string& name, std::span<const Vec3f> cloud_world_m,
                       const Scenario& scenario, const ScoreWish& wish, int threads,
                       std::vector<std::string>& warnings) {
  const World world = load_world_anywhere(scenario, warnings);
  const RayScene scene(world);
  const std::vector<Vec3f> points_m =
      scorable_points(name, cloud_world_m, scenario.planner.floor_z_m, scene,
                      bounds_m(world.structure), smallest_voxel_m(scenario, wish));
  Scored scored = score(scenario, world, scene, {.points_world_m = points_m}, wish, threads);
  scored.points_below_floor = cloud_world_m.size() - points_m.size();
  return scored;
}

Scored score_run(const fs::path& run, const ScoreWish& wish, int threads) {
  const RunSummary summary = read_summary(run);
  const auto need = [&](bool is_there, const char* what) {
    if (!is_there) throw BadInput("{}: {}", (run / kSummaryFile).string(), what);
  };
  need(summary.profile_end_s.has_value(), "/profile_end_s: is missing");
  need(summary.profile_m.has_value(), "/distance_m/profile: is missing");
  need(summary.transfer_m.has_value(), "/distance_m/transfer: is missing");
  need(summary.iterations.has_value(), "/iterations: is missing");
  const Scenario scenario = load_scenario((run / kScenarioFile).string(), {});
  const fs::path cloud_path = run / kCloudFile;
  const std::vector<Vec3f> points = read_cloud(cloud_path);
  need_voxels(cloud_path.string(), points, smallest_voxel_m(scenario, wish));
  const std::vector<Vec3f> profile = read_cloud(run / kProfileCloudFile);
  const std::vector<ViewRecord> views = read_view_records(run / kIterationsFile);
  const ScoredCloud cloud{.points_world_m = points,
                          .profile_points = profile.size(),
                          .before = {.profile_m = *summary.profile_m,
                                     .transfer_m = *summary.transfer_m,
                                     .profile_end_s = *summary.profile_end_s},
                          .views = view_marks(scenario, views)};
  need_matching(run, cloud, profile, *summary.iterations);
  need_views_of_summary(run / kIterationsFile, summary, views);
  std::vector<std::string> warnings;  // the mission told them
  const World world = load_world_anywhere(scenario, warnings);
  need_same_inputs(run, world_inputs(scenario, world),
                   fmt::format("its score would be of another structure; `gnbv score {} --mesh "
                               "FILE` scores the cloud against any",
                               shell_word(cloud_path.string())));
  const RayScene scene(world);
  Scored scored = score(scenario, world, scene, cloud, wish, threads);
  if (!wish.box_m) {
    scored.score.ceiling = run_ceiling(scenario, world, scene, wish.ceiling, threads);
  }
  return scored;
}

}  // namespace gnbv
