#include "planner/map/scan_insertion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

#include "bench/reference/analytic_scans.hpp"
#include "bench/reference/depth_rays.hpp"
#include "bench/reference/octomap_twin.hpp"
#include "tests/planner/map/random_points.hpp"
#include "tests/support/at_simd_level.hpp"

namespace gnbv {
namespace {

const Box3 kBox_m(Vec3(-3, -2.5, 0), Vec3(3.1, 2.5, 2));

/// Float log-odds bit for bit, and whether the node exists, over all voxels of the grid.
void expect_equal(const OccupancyGrid& grid, const OctomapTwin& twin) {
  std::size_t measured = 0;
  const auto voxels = static_cast<VoxelIndex>(grid.geometry().voxel_count());
  for (VoxelIndex v = 0; v < voxels; ++v) {
    const std::optional<float> expected = twin.log_odds(grid.geometry().key_at(v));
    ASSERT_EQ(grid.is_measured(v), expected.has_value()) << "voxel " << v;
    if (!expected) continue;
    ++measured;
    ASSERT_EQ(std::bit_cast<std::uint32_t>(grid.log_odds(v)),
              std::bit_cast<std::uint32_t>(*expected))
        << "voxel " << v << ": " << grid.log_odds(v) << " against " << *expected;
  }
  EXPECT_GT(measured, voxels / 20) << "the scans hardly touched the grid";
}

/// Hits, clearing rays and floor, ends in and out of the box, some on voxel borders or
/// axis-aligned.
std::vector<ScanRay> random_rays(Random& random, const Vec3f& origin_m, int count) {
  const Box3 around_m(kBox_m.min() - Vec3(2, 2, 1), kBox_m.max() + Vec3(2, 2, 2));
  std::vector<ScanRay> rays;
  for (int i = 0; i < count; ++i) {
    Vec3f end_m = random.point_in(around_m);
    if (random.chance(0.1)) end_m.head<2>() = origin_m.head<2>();
    if (random.chance(0.1)) end_m[1] = std::round(end_m[1] * 5.0F) / 5.0F;
    if (random.chance(0.1)) end_m = origin_m + 0.02F * (end_m - origin_m);
    rays.push_back({end_m, end_m.z() > 0.3F && random.chance(0.6)});
  }
  return rays;
}

/// A map of ours and one of OctoMap's, which see the same.
struct Both {
  explicit Both(const Box3& box_m, double resolution_m = OccupancyConfig{}.resolution_m)
      : grid(OccupancyConfig{.resolution_m = resolution_m}, box_m),
        walker(grid.geometry()),
        twin(grid.config()) {}
  void insert(const Vec3f& origin_m, const std::vector<ScanRay>& rays) {
    grid.apply(walker.compute_update(origin_m, rays));
    twin.insert(origin_m, rays);
  }
  OccupancyGrid grid;
  FanWalker walker;
  OctomapTwin twin;
};

class ScanInsertionAt : public AtSimdLevel {};

TEST_P(ScanInsertionAt, GridEqualsOctomapVoxelByVoxel) {
  for (const double resolution_m : {0.2, 0.07, 0.05}) {
    Both maps(kBox_m, resolution_m);
    Random random(23);
    for (int scan = 0; scan < 9; ++scan) {
      Vec3f origin_m = random.point_in(kBox_m);
      if (scan == 3) origin_m = {-4.0F, 0.0F, 1.0F};  // outside, looking in
      if (scan == 5) origin_m = {0.0F, 0.2F, 1.0F};   // on voxel borders
      maps.insert(origin_m, random_rays(random, origin_m, 400));
    }
    expect_equal(maps.grid, maps.twin);
  }
}

TEST_P(ScanInsertionAt, RaysFromOutsideTheGridEqualOctomapVoxelByVoxel) {
  Both maps(kBox_m);
  Random random(29);
  const Box3 around_m(kBox_m.min() - Vec3::Constant(1.0), kBox_m.max() + Vec3::Constant(1.0));
  int outside = 0;
  while (outside < 60) {
    Vec3f origin_m = random.point_in(around_m);
    // some beside a face by a hair, as a vehicle on the workspace's border
    if (outside % 3 == 0) origin_m.x() = static_cast<float>(kBox_m.min().x()) - 1e-3F;
    if (kBox_m.contains(origin_m.cast<double>())) continue;
    ++outside;
    maps.insert(origin_m, random_rays(random, origin_m, 200));
  }
  expect_equal(maps.grid, maps.twin);
}

// where borders of two or three axes are crossed at once, OctoMap's order decides
TEST_P(ScanInsertionAt, RaysAlongDiagonalsEqualOctomapVoxelByVoxel) {
  for (const double resolution_m : {0.2, 0.25}) {  // the second one's half is exact: all tie
    Both maps(Box3(Vec3(-1, -1, -1), Vec3(1.2, 1.2, 1.2)), resolution_m);
    const Vec3f origin_m = Vec3f::Constant(static_cast<float>(0.5 * resolution_m));
    std::vector<ScanRay> rays;
    for (int direction = 0; direction < 27; ++direction) {
      const Eigen::Vector3i towards(direction % 3 - 1, direction / 3 % 3 - 1, direction / 9 - 1);
      rays.push_back({origin_m + 0.8F * towards.cast<float>(), false});
    }
    maps.insert(origin_m, rays);
    expect_equal(maps.grid, maps.twin);
  }
}

TEST_P(ScanInsertionAt, GridsOfOneRowOrLayerEqualOctomapVoxelByVoxel) {
  for (const Vec3& size_m : {Vec3(6, 0.2, 0.2), Vec3(0.2, 6, 0.2), Vec3(0.2, 0.2, 6),
                             Vec3(6, 4, 0.2), Vec3(0.2, 4, 6)}) {
    const Box3 box_m(Vec3::Zero(), size_m);
    Both maps(box_m);
    Random random(41);
    for (int scan = 0; scan < 5; ++scan) {
      const Vec3f origin_m = random.point_in(box_m);
      std::vector<ScanRay> rays;
      for (int i = 0; i < 100; ++i) rays.push_back({random.point_in(box_m), i % 2 == 0});
      maps.insert(origin_m, rays);
    }
    expect_equal(maps.grid, maps.twin);
  }
}

// at 0.06 m half a voxel, rounded to float32, is less than half: a ray that begins a hair below a
// border has crossed it long ago by OctoMap's reckoning, and one that rests in a bundle may not
// step on from there
TEST_P(ScanInsertionAt, RaysOfAScanBeforeLeaveNothingBehind) {
  const GridGeometry grid(Box3(Vec3(-1, -1, 0), Vec3(1, 1, 2)), 0.06);
  FanWalker walker(grid);
  const std::vector<ScanRay> before(16, {Vec3f(0.0F, 0.0F, 0.1F), false});
  walker.compute_update(Vec3f(-1e-10F, -1e-10F, 1.03F), before);
  const Vec3f origin_m(0.5F, 0.5F, 0.5F);
  const std::vector<ScanRay> one = {{Vec3f(0.8F, 0.5F, 0.5F), false}};
  EXPECT_EQ(walker.compute_update(origin_m, one).free,
            FanWalker(grid).compute_update(origin_m, one).free);
}

TEST_P(ScanInsertionAt, DepthFramesEqualOctomapVoxelByVoxel) {
  CameraConfig camera_config;
  camera_config.width_px = 80;
  camera_config.height_px = 60;
  camera_config.pitch_rad = deg_to_rad(20.0);
  const CameraModel camera = make_camera_model(camera_config);
  const AnalyticScene scene = example_scene();
  Both maps(Box3(Vec3(-10, -10, 0), Vec3(10, 10, 8)));
  for (int view = 0; view < 12; ++view) {
    const double angle_rad = view * kPi / 6.0;
    const ViewPose pose = {Vec3(8.0 * std::cos(angle_rad), 8.0 * std::sin(angle_rad), 5.0),
                           angle_rad + kPi};
    const DepthFrame frame = analytic_depth(scene, camera, T_world_body(pose));
    const Vec3f origin_m = frame.T_world_camera.translation().cast<float>();
    maps.insert(origin_m, rays_of(frame, camera, 0.3));
  }
  EXPECT_GT(maps.grid.occupied_count(), 300U);
  expect_equal(maps.grid, maps.twin);
}

std::vector<LidarScan> example_scans(const LidarConfig& lidar, int count) {
  const AnalyticScene scene = example_scene();
  std::vector<LidarScan> scans;
  for (int s = 0; s < count; ++s) {
    const ViewPose pose = {Vec3(-9.0, -9.0 + 0.05 * s, 7.5 - 0.05 * s), 0.4};
    scans.push_back(analytic_scan(scene, lidar, T_world_body(pose)));
  }
  return scans;
}

TEST(ScanInsertion, LidarSweepsEqualOctomapVoxelByVoxel) {
  LidarConfig lidar;
  lidar.beams = 120;
  const LidarModel model = make_lidar_model(lidar);
  const std::vector<LidarScan> scans = example_scans(lidar, 70);  // more than one batch
  OccupancyGrid grid(OccupancyConfig{}, Box3(Vec3(-10, -10, 0), Vec3(10, 10, 8)));
  OctomapTwin twin(grid.config());
  ScanInserter(grid.geometry()).insert_scans(grid, scans, {&model, 1}, 0.3, 2);
  for (const LidarScan& scan : scans) {
    twin.insert(scan.T_world_lidar.translation().cast<float>(), rays_of(scan, model, 0.3));
  }
  expect_equal(grid, twin);
}

TEST_P(ScanInsertionAt, RaysThatLeaveTheGridSideBySideStopThere) {
  const GridGeometry grid(kBox_m, 0.2);
  const Vec3f origin_m(0.1F, 0.1F, 1.1F);
  const std::vector<ScanRay> rays(8, {Vec3f(0.1F, 0.1F, 50.0F), false});
  const ScanUpdate update = FanWalker(grid).compute_update(origin_m, rays);
  std::vector<VoxelIndex> expected;
  for (std::int32_t z = 5; z < 10; ++z) expected.push_back(grid.index_of({0, 0, z}));
  EXPECT_EQ(update.free, expected);
}

GNBV_AT_EVERY_SIMD_LEVEL(ScanInsertionAt);

}  // namespace
}  // namespace gnbv
