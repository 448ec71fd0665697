// What a sweep that is a view leaves in map and cloud, and what a LIDAR's candidate view counts.
#include <gtest/gtest.h>

#include "planner/planners.hpp"
#include "sim/core/rng.hpp"

namespace gnbv {
namespace {

const Box3 kWorkspace_m(Vec3(-6, -6, 0), Vec3(6, 6, 6));

LidarConfig rings() {
  LidarConfig lidar;
  lidar.pattern = LidarPattern::spinning;
  lidar.looks = LidarLooks::views;
  lidar.beams = 360;
  lidar.fov_rad = 2.0 * kPi;
  lidar.pitch_rad = 0.1;
  lidar.p_body_m = {0.0, 0.1, 0.2};
  return lidar;
}

PlannerModel model_of(const LidarConfig& lidar) {
  return make_model({}, kWorkspace_m, {}, std::vector{lidar});
}

LidarScan random_scan(const PlannerModel& model, std::uint64_t seed) {
  LidarScan scan;
  scan.T_world_lidar = T_world_body({{0.5, -0.3, 2.5}, 0.4}) * model.lidars[0].T_body_lidar;
  for (std::size_t i = 0; i < beam_count(model.lidars[0].config); ++i) {
    const double u = uniform01({seed, Stream::bench, 3, i});
    scan.range_m.push_back(u < 0.1   ? kNoReturn
                           : u < 0.2 ? kInvalidRange
                                     : static_cast<float>(0.5 + 6.0 * u));
  }
  return scan;
}

TEST(LidarLook, LeavesTheMapThatAProfilesSweepLeavesAndItsPointsAtTheViewsLeaf) {
  const PlannerModel model = model_of(rings());
  ASSERT_TRUE(model.looks(0));
  Scratch scratch(model, 2);
  Belief as_profile(model), as_view(model);
  for (std::uint64_t seed : {1, 2, 3}) {
    const LidarScan scan = random_scan(model, seed);
    integrate_profile(model, std::span(&scan, 1), scratch, as_profile);
    integrate_looks(model, std::span(&scan, 1), scratch, as_view);
  }
  EXPECT_TRUE(std::ranges::equal(as_view.grid.all_log_odds(), as_profile.grid.all_log_odds()));
  EXPECT_GT(as_view.grid.occupied_count(), 100U);
  SurfaceCloud expected(model.belief.cloud, as_view.grid.geometry());
  for (std::uint64_t seed : {1, 2, 3}) {
    const LidarScan scan = random_scan(model, seed);
    expected.add(surface_points_world_m(rays_of(scan, model.lidars[0], model.belief.floor_z_m)),
                 model.belief.cloud.leaf_m);
  }
  EXPECT_TRUE(std::ranges::equal(as_view.cloud.points_world_m(), expected.points_world_m()));
  EXPECT_EQ(as_view.frame_poses.size(), 3U * 4U);  // a quarter turn each
}

TEST(LidarLook, ACandidateCountsTheVoxelsThatItsBeamsCross) {
  LidarConfig lidar = rings();
  lidar.range_max_m =
      3.0;  // 0.2 m at 3 m are 3.8 degrees: of 1 degree each third azimuth, all rings
  const PlannerModel model = model_of(lidar);
  const Belief belief(model);
  VisitMarks marks(belief.grid.geometry().voxel_count());
  const ViewPose view = {{0.53, -0.31, 3.07}, 0.3};
  const ViewStats stats = evaluate_view(belief.grid, belief.cloud, model.rays_at(0.0), view, marks,
                                        {.detail = ViewDetail::rays});
  // the beams themselves, one azimuth in three: pixels begin half a step after the first beam
  const GridGeometry& grid = belief.grid.geometry();
  const Isometry T = T_world_body(view) * model.lidars[0].T_body_lidar;
  const RayOrigin origin = make_ray_origin(grid, T.translation().cast<float>());
  std::vector<std::uint8_t> is_seen(grid.voxel_count(), 0);
  std::size_t rays = 0;
  for (int azimuth = 0; azimuth < 360; azimuth += 3) {
    for (int ring = 0; ring < 16; ++ring, ++rays) {
      const double azimuth_rad = deg_to_rad(-180.0 + azimuth + 89.5 - 2.0 * (azimuth % 90));
      const Vec3f d = direction_of({azimuth_rad, deg_to_rad(-15.0 + 2.0 * ring)});
      walk_ray_inside(grid, origin, (T * (3.0 * d.cast<double>())).cast<float>(),
                      [&](VoxelIndex v) { return is_seen[v] = 1, true; });
    }
  }
  const auto expected = static_cast<double>(std::ranges::count(is_seen, 1));
  EXPECT_EQ(stats.rays, rays);
  EXPECT_NEAR(stats.unknown_voxels, expected, 0.002 * expected);
  const double field_m3 = 4.0 * kPi * std::sin(deg_to_rad(16.0)) * 27.0 / 3.0;
  // a walk ends before the voxel with the ray's end, which is half a voxel on the average
  EXPECT_NEAR(stats.unknown_volume_m3, field_m3 * std::pow(2.9 / 3.0, 3), 0.02 * field_m3);
  EXPECT_NEAR(model.view_voxels, field_m3 / 0.008, 1.0);
}

TEST(LidarLook, WithoutCamerasEveryLidarLooksWithCamerasThoseThatAreAskedTo) {
  const LidarConfig profiling;
  EXPECT_TRUE(make_model({}, kWorkspace_m, {}, std::vector{profiling}).looks(0));
  const std::vector cameras = {CameraConfig{}};
  const PlannerModel both =
      make_model({}, kWorkspace_m, cameras, std::vector{profiling, rings(), profiling});
  EXPECT_FALSE(both.looks(0));
  EXPECT_TRUE(both.looks(1));
  EXPECT_FALSE(both.looks(2));
  EXPECT_EQ(both.sights.size(), 1U + 4U);
}

}  // namespace
}  // namespace gnbv
