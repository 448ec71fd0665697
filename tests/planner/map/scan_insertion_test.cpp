#include "planner/map/scan_insertion.hpp"

#include <gtest/gtest.h>

#include <bit>

#include "bench/reference/analytic_scans.hpp"
#include "bench/reference/octomap_twin.hpp"
#include "tests/planner/map/random_points.hpp"
#include "tests/support/at_simd_level.hpp"

namespace gnbv {
namespace {

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
std::vector<ScanRay> random_rays(Random& random, const Box3& box_m, const Vec3f& origin_m,
                                 int count) {
  const Box3 around_m(box_m.min() - Vec3(2, 2, 1), box_m.max() + Vec3(2, 2, 2));
  std::vector<ScanRay> rays;
  for (int i = 0; i < count; ++i) {
    Vec3f end_m = random.point_in(random.chance(0.3) ? box_m : around_m);
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
  struct Case {
    Vec3 size_m;
    double resolution_m, beyond_m;  // how far outside rays begin
  };
  for (const auto& [size_m, resolution_m, beyond_m] :
       std::vector<Case>{{{6.1, 5, 2}, 0.2, 0.0},
                         {{6.1, 5, 2}, 0.07, 0.0},
                         {{6.1, 5, 2}, 0.05, 0.0},
                         {{6.1, 5, 2}, 0.2, 1.0},
                         {{6, 0.2, 0.2}, 0.2, 0.0},  // rows, and layers
                         {{0.2, 6, 0.2}, 0.2, 0.0},
                         {{0.2, 0.2, 6}, 0.2, 0.0},
                         {{6, 4, 0.2}, 0.2, 0.0},
                         {{0.2, 4, 6}, 0.2, 0.0}}) {
    const Box3 box_m(Vec3(-3, -2.5, 0), Vec3(-3, -2.5, 0) + size_m);
    const Vec3 margin_m = Vec3::Constant(beyond_m);
    Both maps(box_m, resolution_m);
    Random random(23);
    for (int scan = 0; scan < (beyond_m > 0.0 ? 60 : 9); ++scan) {
      Vec3f origin_m = random.point_in(Box3(box_m.min() - margin_m, box_m.max() + margin_m));
      if (scan == 3) origin_m = {-4.0F, 0.0F, 1.0F};  // outside, looking in
      if (scan == 5) origin_m = {0.0F, 0.2F, 1.0F};   // on voxel borders
      // beside a face by a hair, as a vehicle on the workspace's border
      if (scan % 9 == 7) origin_m.x() = static_cast<float>(box_m.min().x()) - 1e-3F;
      maps.insert(origin_m, random_rays(random, box_m, origin_m, 300));
    }
    expect_equal(maps.grid, maps.twin);
  }
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
    rays.resize(35, {origin_m + Vec3f(0, 0, 50), false});  // side by side out of the grid
    maps.insert(origin_m, rays);
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

TEST(ScanInsertion, LidarSweepsEqualOctomapVoxelByVoxel) {
  LidarConfig lidar;
  lidar.beams = 120;
  const LidarModel model = make_lidar_model(lidar);
  std::vector<LidarScan> scans;
  for (int s = 0; s < 70; ++s) {  // more than one batch
    const ViewPose pose = {Vec3(-9.0, -9.0 + 0.05 * s, 7.5 - 0.05 * s), 0.4};
    scans.push_back(analytic_scan(example_scene(), lidar, T_world_body(pose)));
  }
  OccupancyGrid grid(OccupancyConfig{}, Box3(Vec3(-10, -10, 0), Vec3(10, 10, 8)));
  OctomapTwin twin(grid.config());
  ScanInserter(grid.geometry()).insert_scans(grid, scans, {&model, 1}, 0.3, 2);
  for (const LidarScan& scan : scans) {
    twin.insert(scan.T_world_lidar.translation().cast<float>(), rays_of(scan, model, 0.3));
  }
  expect_equal(grid, twin);
}

GNBV_AT_EVERY_SIMD_LEVEL(ScanInsertionAt);

}  // namespace
}  // namespace gnbv
