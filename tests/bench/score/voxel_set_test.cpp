#include "bench/score/voxel_set.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "bench/score/coverage_curve.hpp"
#include "bench/score/mission_score.hpp"
#include "bench/score/sized_coverage.hpp"
#include "sim/core/error.hpp"
#include "sim/core/rng.hpp"
#include "tests/bench/shapes.hpp"
#include "tests/support/fault.hpp"

namespace gnbv {
namespace {

// Half of them on multiples of 0.05 m, where a voxel ends and the next begins.
std::vector<Vec3f> random_points(std::size_t count, std::uint64_t seed) {
  std::vector<Vec3f> points;
  for (std::size_t i = 0; i < count; ++i) {
    Vec3 p;
    for (std::uint64_t axis = 0; axis < 3; ++axis) {
      const double x = 4.0 * uniform01({seed, Stream::bench, i, axis}) - 2.0;
      p[static_cast<Eigen::Index>(axis)] = i % 2 == 0 ? x : std::round(20.0 * x) / 20.0;
    }
    points.push_back(p.cast<float>());
  }
  return points;
}

TEST(VoxelCode, VoxelsAreHalfOpen) {
  // 0.25 and 0.5 are exact in float: the first point of voxels 5 and 10
  for (const float x : {0.25F, 0.5F, 0.0F, -0.25F, 100.0F}) {
    const double k = static_cast<double>(x) * 20.0;
    const float below = std::nextafter(x, -1e9F);
    EXPECT_NEAR(voxel_centre_m(voxel_code({x, 0, 0}, 0.05), 0.05).x(), (k + 0.5) * 0.05, 1e-9);
    EXPECT_NEAR(voxel_centre_m(voxel_code({below, 0, 0}, 0.05), 0.05).x(), (k - 0.5) * 0.05, 1e-9);
  }
}

TEST(VoxelCode, CentreLiesInItsVoxel) {
  for (const Vec3f& p : random_points(1000, 1)) {
    for (const double size_m : {0.05, 0.1, 0.5, 0.3}) {
      const std::uint64_t code = voxel_code(p, size_m);
      const Vec3 centre = voxel_centre_m(code, size_m);
      EXPECT_EQ(voxel_code(centre.cast<float>(), size_m), code);
      // half a voxel and the rounding of float at 2 m
      EXPECT_LE((centre - p.cast<double>()).cwiseAbs().maxCoeff(), 0.5 * size_m + 1e-6);
    }
  }
}

TEST(VoxelSet, CoarserSizesNestExactly) {
  const std::vector<Vec3f> points = random_points(20000, 2);
  const VoxelSet finest = voxels_of(points, kCoverageSizes_m[0]);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(coarser(finest, kCoverageFactors[i]), voxels_of(points, kCoverageSizes_m[i]));
  }
}

TEST(VoxelSet, NamesThePointThatHasNoVoxel) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(),
                          std::numeric_limits<float>::infinity(), 1e6F, -1e6F}) {
    std::vector<Vec3f> points = random_points(5, 4);
    points[3].y() = bad;
    EXPECT_TRUE(test::says(test::fault_of([&] { voxels_of(points, 0.05); }), {"point 3"})) << bad;
    EXPECT_THROW(voxel_code(points[3], 0.05), BrokenInvariant);
  }
}

/// A cube of a metre whose faces lie in the middle of voxels of 0.04 m.
World cube() {
  World world;
  test::add_box(world.structure, Vec3(1.02, 1.02, 1.02), Vec3(1, 1, 1));
  return world;
}

/// Of a shell of n voxels along each axis.
double shell(double n) { return n * n * n - (n - 2) * (n - 2) * (n - 2); }

SizedShares shares_of(const World& world, double size_m, std::span<const Vec3f> cloud,
                      const Box3& region_m = ReferenceConfig{}.region_m, int threads = 2) {
  const std::vector<std::size_t> prefixes = {cloud.size()};
  return sized_shares(world, size_m, {.floor_z_m = 0.3, .region_m = region_m}, cloud, prefixes,
                      threads);
}

TEST(SizeName, HasTwoDecimalsAtLeast) {
  EXPECT_EQ(size_name(0.05), "0.05");
  EXPECT_EQ(size_name(0.1), "0.10");
  EXPECT_EQ(size_name(0.025), "0.025");
  EXPECT_EQ(size_name(2.0), "2.00");
}

TEST(SizedShares, APointCoversOneOfTheVoxelsOfTheShell) {
  const std::vector<Vec3f> cloud = {{1.5F, 1.5F, 1.021F}, {1.5F, 1.5F, 1.5F}};  // one is inside
  for (const int threads : {1, 3}) {
    const SizedShares shares = shares_of(cube(), 0.04, cloud, ReferenceConfig{}.region_m, threads);
    EXPECT_DOUBLE_EQ(shares.counted.at(0), 1.0 / shell(26));  // from 1.00 to 2.04 m
    EXPECT_DOUBLE_EQ(shares.raw.at(0), 1.0 / shell(26));
  }
}

TEST(SizedShares, OfABoxAreOfTheVoxelsWithTheirCentresInIt) {
  const std::vector<Vec3f> cloud = {{1.5F, 1.5F, 1.021F}, {1.5F, 1.5F, 2.019F}};
  // the lowest layer, a whole square of the shell, has its centres at 1.02 m
  const Box3 low(Vec3(0, 0, 1.0), Vec3(3, 3, 1.03));
  EXPECT_DOUBLE_EQ(shares_of(cube(), 0.04, cloud, low).counted.at(0), 1.0 / (26 * 26));
  const Box3 lower(Vec3(0, 0, 1.0), Vec3(3, 3, 1.019));
  EXPECT_EQ(shares_of(cube(), 0.04, cloud, lower).counted.at(0), 0.0);
}

TEST(SizedShares, OfThePapersSizesAreThePapers) {
  World world = cube();
  test::add_box(world.structure, Vec3(1.2, 1.2, 1.2), Vec3(0.4, 0.4, 0.4));  // inside
  // walls on all sides, 3 m off: an obstacle that hides nothing at any size
  test::add_box(world.obstacles, Vec3(-1.98, -1.98, -1.98), Vec3(7, 7, 7));
  std::mt19937 random(5);
  std::uniform_real_distribution<float> coordinate(0.9F, 2.1F);
  std::vector<Vec3f> cloud;
  for (int i = 0; i < 20000; ++i) {
    cloud.emplace_back(coordinate(random), coordinate(random), coordinate(random));
  }
  std::vector<double> distances_m;  // of some of them
  for (const Vec3f& p_m : cloud) distances_m.push_back(0.05 * static_cast<double>(p_m.x()));
  const std::vector<std::size_t> prefixes = {100, cloud.size()};
  for (const std::size_t area_samples : {0U, 5000U}) {
    const ReferenceConfig config{.floor_z_m = 0.3, .area_samples = area_samples};
    const SurfaceReference reference = make_surface_reference(world, RayScene(world), config, 2);
    const auto papers = coverage_of_prefixes(reference, cloud, prefixes, 2, distances_m);
    EXPECT_GT(papers[1].counted[2], 0.5);
    for (std::size_t size = 0; size < 3; ++size) {
      const SizedShares ours =
          sized_shares(world, kCoverageSizes_m[size], config, cloud, prefixes, 2, distances_m);
      for (std::size_t i = 0; i < prefixes.size(); ++i) {
        EXPECT_NEAR(ours.raw[i], papers[i].raw[size], 1e-12) << size;
        EXPECT_NEAR(ours.counted[i], papers[i].counted[size], 1e-12) << size;
        EXPECT_NEAR(ours.accurate[i], papers[i].accurate[size], 1e-12) << size;
      }
    }
  }
}

TEST(SizedRoom, IsRefusedByNameOfTheSizeThatFits) {
  TriangleMesh field;
  test::add_sheet(field, Vec3(0, 0, 1), Vec3(100, 0, 0), Vec3(0, 100, 0));
  const auto fault_of = [&](const std::vector<double>& sizes_m) {
    return test::fault_of([&] { need_room_for(sizes_m, field); });
  };
  // 10,000 m2 by (size / 2)^2 are a hundred million at 0.02 m
  EXPECT_EQ(fault_of({0.05, 0.02}), "");
  EXPECT_NE(fault_of({0.05, 0.0199}).find("0.0199: 10000 m2"), std::string::npos);
  EXPECT_NE(fault_of({0.01}).find("0.02 m fits"), std::string::npos);
  for (Vec3f& v : field.vertices_m) v *= 10.0F;
  EXPECT_EQ(fault_of({0.05, 0.10, 0.50}), "");
}

TEST(ScoreMoreSizes, AscendWithoutThePapersAndEndTheirCurvesWithTheLastView) {
  const std::vector<Vec3f> cloud = {
      {1.5F, 1.5F, 1.021F}, {1.5F, 1.5F, 2.019F}, {1.5F, 1.021F, 1.5F}};
  ScoredCloud scored{.points_world_m = cloud, .profile_points = 1};
  scored.views = {{.cloud_points = 1}, {.cloud_points = 2}};  // and a point in flight
  const std::vector<double> sizes_m = {0.2, 0.05, 0.04};
  const World world = cube();
  const auto more =
      score_cloud({}, RayScene(world), scored, 0.2, 2, MoreSizes{sizes_m, world, {}}).more;
  ASSERT_EQ(more.size(), 2U);
  EXPECT_EQ(more[0].size_m, 0.04);
  EXPECT_EQ(more[1].size_m, 0.2);
  const double one = 1.0 / shell(26);
  EXPECT_EQ(more[0].curve.size(), 3U);
  EXPECT_DOUBLE_EQ(more[0].profile, one);
  EXPECT_DOUBLE_EQ(more[0].curve[1], one);
  EXPECT_DOUBLE_EQ(more[0].curve[2], 2 * one);
  EXPECT_DOUBLE_EQ(more[0].final, 3 * one);
}

}  // namespace
}  // namespace gnbv
