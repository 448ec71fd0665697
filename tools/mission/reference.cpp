#include "tools/mission/reference.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include "bench/score/cloud_metrics.hpp"
#include "bench/score/coverage_curve.hpp"
#include "sim/core/error.hpp"
#include "sim/core/text.hpp"
#include "tools/mission/start_pose.hpp"
#include "tools/terminal/progress.hpp"
#include "tools/terminal/say.hpp"

namespace gnbv {
namespace {

/// Coverage of a cloud that grows, by the points that the score counts.
class Meter {
 public:
  Meter(const SurfaceReference& reference, const RayScene& scene)
      : meter_(reference.counted[0], 0), scene_(scene) {}

  double share_of(std::span<const Vec3f> cloud_world_m) {
    GNBV_CHECK(cloud_world_m.size() >= looked_at_, "a cloud shrank from {} to {} points",
               looked_at_, cloud_world_m.size());
    const std::span<const Vec3f> fresh_m = cloud_world_m.subspan(looked_at_);
    const std::vector<std::uint8_t> is_kept = points_of_structure(scene_, fresh_m, 1);
    for (std::size_t i = 0; i < fresh_m.size(); ++i) {
      if (is_kept[i] != 0) own_world_m_.push_back(fresh_m[i]);
    }
    looked_at_ = cloud_world_m.size();
    return meter_.share_of(own_world_m_);
  }

 private:
  CoverageMeter meter_;
  const RayScene& scene_;
  std::vector<Vec3f> own_world_m_;
  std::size_t looked_at_ = 0;
};

/// Says what is about to be spent where that is much, and refuses more than the machine has.
void announce(const Scenario& scenario, const ReferenceCost& cost, int threads) {
  constexpr double kLong_s = 8.0;
  const double seconds = cost.thread_s / std::max(threads, 1);
  const double memory =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  const std::string what = fmt::format(
      "{}: {} m2 of surface, about {:.2g} million voxels of 0.05 m: what there is to see takes "
      "some {} on {} and {:.1f} GB of memory to find",
      structure_name(scenario.structure), grouped(cost.area_m2, 0), 1e-6 * cost.voxels,
      duration_text(seconds), counted(static_cast<std::size_t>(threads), "thread"),
      cost.bytes / 0x1p30);
  if (cost.bytes > memory) {
    throw BadInput(
        "{}, and this machine has {:.1f} GB: fly a part of it, or lower structure.file.scale", what,
        memory / 0x1p30);
  }
  if (seconds > kLong_s) say("{}, once; it is kept", what);
}

}  // namespace

SurfaceReference reference_of(const Scenario& scenario, const World& world, const RayScene& scene,
                              int threads,
                              const std::function<void(const std::string& note)>& show) {
  const double floor_z_m = scenario.planner.floor_z_m;
  const ReferenceConfig config = reference_config(scenario);
  const auto progress = [&](double share_done) {
    if (share_done == 0.0) announce(scenario, cost_of_reference(world.structure, config), threads);
    if (show) show(fmt::format("finding what there is to see: {:.0f} %", 100.0 * share_done));
  };
  SurfaceReference reference = cached_surface_reference(world, scene, config, threads, progress);
  if (reference.counted[0].empty()) {
    const std::string where =
        config.region_m.isApprox(ReferenceConfig{}.region_m) ? "" : " and in score.region_m";
    throw BadInput(
        "{}: nothing to measure: above planner.floor_z_m = {} m{} there is no {}; `gnbv lint` says "
        "more of a mesh",
        structure_name(scenario.structure), floor_z_m, where,
        config.area_samples == 0 ? "voxel with surface enough that can be seen from outside"
                                 : "surface that a sample could be drawn from");
  }
  return reference;
}

bool is_noisy(const Scenario& scenario) {
  return scenario.vehicle.estimate.model != EstimateModel::none ||
         std::ranges::any_of(
             scenario.cameras,
             [](const CameraConfig& camera) { return camera.noise.model != DepthNoise::none; }) ||
         std::ranges::any_of(scenario.lidars, [&](const LidarConfig& lidar) {
           const bool is_skewed = lidar.rolling && lidar.looks == LidarLooks::flight;
           return is_skewed ||
                  (lidar.range_sigma_m > 0.0 && looks_at_views(lidar, !scenario.cameras.empty()));
         });
}

MissionScore score_as_asked(const Scenario& scenario, const World& world, const RayScene& scene,
                            const SurfaceReference& reference, ScoredCloud cloud, int threads) {
  const ScoreConfig& asked = scenario.score;
  cloud.region_m = asked.region_m;
  MissionScore score =
      score_cloud(reference, scene, cloud, scenario.planner.map.resolution_m, threads,
                  MoreSizes{asked.sizes_m, world, reference_config(scenario)});
  score.is_noisy = is_noisy(scenario);
  score.budgets = {static_cast<double>(asked.budget_views), asked.budget_m, asked.budget_s};
  return score;
}

std::optional<double> run_ceiling(const Scenario& scenario, const World& world,
                                  const RayScene& scene, CeilingFrom from, int threads) {
  const ViewPose start = start_pose(scenario, scene);
  const std::optional<Ceiling> ceiling =
      from == CeilingFrom::search ? find_ceiling(scenario, world, scene, start, threads)
                                  : known_ceiling(scenario, world, scene, start, threads);
  if (!ceiling || ceiling->leaf_counted[0] <= 0.0) return std::nullopt;
  return ceiling->leaf_counted[0];
}

std::function<double(const Belief&)> coverage_meter(const SurfaceReference& reference,
                                                    const RayScene& scene) {
  const auto meter = std::make_shared<Meter>(reference, scene);
  return [meter](const Belief& belief) { return meter->share_of(belief.cloud.points_world_m()); };
}

std::function<bool(const Belief&)> coverage_goal(const BenchmarkConfig& benchmark,
                                                 const SurfaceReference& reference,
                                                 const RayScene& scene) {
  const double goal = benchmark.stop_at_coverage;
  if (goal <= 0.0) return [](const Belief&) { return false; };
  return [share_of = coverage_meter(reference, scene), goal](const Belief& belief) {
    return share_of(belief) >= goal;
  };
}

}  // namespace gnbv
