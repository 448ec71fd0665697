// What of the surface missions can see, and what their clouds can keep of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bench/limits/ceiling.hpp"
#include "bench/limits/cloud_of_views.hpp"
#include "sim/core/rng.hpp"
#include "tests/bench/limits/limits_setting.hpp"
#include "tests/bench/shapes.hpp"
#include "tests/support/flown.hpp"

namespace gnbv {
namespace {

Scenario noise_free(const std::string& name, const std::string& utility, int views) {
  Scenario scenario =
      load_scenario(name, {"planner.utility.name=" + utility, "vehicle.estimate.model=none",
                           "planner.termination.max_iterations=" + std::to_string(views)});
  for (CameraConfig& camera : scenario.cameras) camera.noise.model = DepthNoise::none;
  for (LidarConfig& lidar : scenario.lidars) lidar.range_sigma_m = 0.0;
  return scenario;
}

TEST(SeenSurface, IsNoLessThanWhatNoiseFreeMissionsCover) {
  constexpr double kOneOfVoxel_m = 0.05;
  constexpr double kBeyondVoxels_m = 0.04;
  for (const auto& [name, utility, views, leaf_m] :
       {std::tuple("smoke", "bircher", 12, kOneOfVoxel_m),
        std::tuple("smoke", "proposed", 60, kBeyondVoxels_m),
        std::tuple("lab_model", "isler", 15, 0.02),
        std::tuple("lab_airplane", "bircher", 15, 0.02)}) {
    Scenario scenario = noise_free(name, utility, views);
    scenario.planner.cloud.leaf_m = leaf_m;
    if (leaf_m == kBeyondVoxels_m) {  // enough pixels and views to fill the leaves
      scenario.cameras[0].width_px = 640;
      scenario.cameras[0].height_px = 480;
    }
    const LimitsSetting m(scenario);
    const SeenSurface seen = m.seen();
    const Ceiling ceiling = find_ceiling(scenario, m.world, m.scene, m.start, 2);
    const Flown flown(scenario);
    const auto cloud = flown.result.belief.cloud.points_world_m();
    const auto covered = coverage_at_all_sizes(m.reference.counted, cloud);
    for (std::size_t size = 0; size < 3; ++size) {
      EXPECT_LE(covered[size], ceiling.counted[size]) << name << " " << size;
      EXPECT_LE(covered[size], ceiling.leaf_counted[size]) << name << " " << size;
    }
    // and voxel by voxel, but for the few where the leaf's centroid lies beside the surface
    const VoxelSet voxels = voxels_of(cloud, kCoverageSizes_m[0]);
    std::size_t in_reference = 0;
    std::size_t unseen = 0;
    for (const std::uint64_t code : m.reference.counted[0]) {
      if (!std::binary_search(voxels.begin(), voxels.end(), code)) continue;
      ++in_reference;
      unseen += std::binary_search(seen.voxels.begin(), seen.voxels.end(), code) ? 0 : 1;
    }
    EXPECT_GT(in_reference, 1000U);
    EXPECT_LE(static_cast<double>(unseen), 0.005 * static_cast<double>(in_reference)) << name;
  }
}

TEST(SeenSurface, HasWhatViewsFromLegalPositionsShow) {
  const LimitsSetting lab(load_scenario("lab_airplane", {}));
  const auto& [scenario, warnings, world, scene, start, legal, reference] = lab;
  const SeenSurface seen = lab.seen();
  const std::vector<CameraModel> cameras = exact_cameras(scenario);
  const Vec3 centre_m = bounds_m(world.structure).center();
  VoxelSet shown;
  std::vector<FrameRays> rays;
  for (std::uint64_t i = 0; i < 300; ++i) {
    const auto at = static_cast<std::size_t>(uniform01({3, Stream::bench, i, 0}) *
                                             static_cast<double>(legal.size()));
    const Vec3 to_m = centre_m - legal.p_world_m[at];
    const double yaw_rad =
        std::atan2(to_m.y(), to_m.x()) + 0.5 * uniform01({3, Stream::bench, i, 1}) - 0.25;
    take_view(scene, cameras, {legal.p_world_m[at], yaw_rad}, scenario.planner.floor_z_m, 2, rays);
    for (const std::uint32_t voxel : finds_alone(reference.counted[0], rays, 0.02)) {
      shown.push_back(reference.counted[0][voxel]);
    }
  }
  std::sort(shown.begin(), shown.end());
  shown.erase(std::unique(shown.begin(), shown.end()), shown.end());
  ASSERT_GT(shown.size(), 3000U);
  const auto missed = std::count_if(shown.begin(), shown.end(), [&](std::uint64_t code) {
    return !std::binary_search(seen.voxels.begin(), seen.voxels.end(), code);
  });
  EXPECT_LE(static_cast<double>(missed), 0.002 * static_cast<double>(shown.size()));
}

TEST(SeenSurface, AVoxelKeepsAPointOfALeafThatItHasAQuarterOf) {
  setenv("GNBV_CACHE", "", 1);
  Scenario scenario = load_scenario("smoke", {});
  scenario.planner.cloud.leaf_m = 0.02;
  for (const double width_m : {0.005, 0.002}) {
    // a wall whose last bit reaches into another voxel, beyond x = 1.05, in the middle of a leaf:
    // a third of the leaf's surface, or a sixth
    World world{TriangleMesh{}, true};
    test::add_sheet(world.structure, Vec3(1.05 - width_m, 0.01, 1.0), Vec3(0.5, 0, 0),
                    Vec3(0, 0, 0.6));
    const RayScene scene(world);
    const ViewPose start = start_pose(scenario, scene);
    const LegalViewpoints legal = find_legal_viewpoints(scenario, scene, start, 2);
    const SurfaceReference reference = make_surface_reference(world, scene, {}, 2);
    const SeenSurface seen = find_seen_surface(scenario, world, scene, legal, reference, 2, {});
    const VoxelSet kept = voxels_of(seen.kept_world_m, kCoverageSizes_m[0]);
    const std::uint64_t last = voxel_code(Vec3f(1.049F, 0.01F, 1.23F), kCoverageSizes_m[0]);
    EXPECT_TRUE(std::binary_search(seen.voxels.begin(), seen.voxels.end(), last));
    EXPECT_EQ(std::binary_search(kept.begin(), kept.end(), last), width_m > 0.004) << width_m;
    EXPECT_TRUE(std::includes(seen.voxels.begin(), seen.voxels.end(), kept.begin(), kept.end()));
  }
}

TEST(Ceiling, IsMeasuredAgainstWhatItsMissionsAre) {
  Scenario scenario = noise_free("smoke", "bircher", 12);
  const Flown flown(scenario);
  const auto cloud = flown.result.belief.cloud.points_world_m();
  std::array<Ceiling, 2> ceilings;
  for (const ScoreReference reference : {ScoreReference::outside, ScoreReference::area_samples}) {
    scenario.score.reference = reference;
    const LimitsSetting m(scenario);
    Ceiling& ceiling = ceilings[reference == ScoreReference::outside ? 0 : 1];
    ceiling = find_ceiling(scenario, m.world, m.scene, m.start, 2);
    EXPECT_EQ(ceiling.area_samples, m.reference.area_samples);
    const auto covered = coverage_at_all_sizes(m.reference.counted, cloud);
    for (std::size_t size = 0; size < 3; ++size) {
      EXPECT_LE(covered[size], ceiling.leaf_counted[size]) << size;
      EXPECT_LE(ceiling.leaf_counted[size], ceiling.counted[size]) << size;
    }
    EXPECT_GT(covered[0], 0.5 * ceiling.leaf_counted[0]);
  }
  // of the inner surface, which is asked for, nothing can be had
  EXPECT_LT(ceilings[1].counted[0], ceilings[0].counted[0]);
  EXPECT_NEAR(ceilings[1].raw[0], ceilings[0].raw[0], 1e-3);
  const std::string json = ceiling_json(scenario, ceilings[1], 0.0);
  EXPECT_NE(json.find("\"leaf_area_samples\""), std::string::npos);
  EXPECT_EQ(json.find("outside"), std::string::npos);
  EXPECT_NE(ceiling_text(ceilings[1], 0.0).find("155,000 points drawn by area"), std::string::npos);
}

TEST(Ceiling, LeavesLoseNothingOfSizesThatTheyDivide) {
  for (const auto& [name, leaf_m] :
       {std::pair("smoke", 0.05), std::pair("smoke", 0.02), std::pair("lab_model", 0.02)}) {
    Scenario scenario = load_scenario(name, {});
    scenario.planner.cloud.leaf_m = leaf_m;
    const LimitsSetting m(scenario);
    const Ceiling ceiling = find_ceiling(scenario, m.world, m.scene, m.start, 2);
    EXPECT_LE(ceiling.leaf_counted[0], ceiling.counted[0]) << name;
    for (const std::size_t size : {1U, 2U}) {
      EXPECT_EQ(ceiling.leaf_counted[size], ceiling.counted[size]) << name << " " << size;
      EXPECT_EQ(ceiling.leaf_raw[size], ceiling.raw[size]) << name << " " << size;
    }
    EXPECT_LT(ceiling.raw[0], ceiling.counted[0]) << name;
  }
}

}  // namespace
}  // namespace gnbv
