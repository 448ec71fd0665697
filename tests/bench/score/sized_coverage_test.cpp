#include "bench/score/sized_coverage.hpp"

#include <gtest/gtest.h>

#include <random>

#include "bench/score/coverage_curve.hpp"
#include "bench/score/mission_score.hpp"
#include "sim/core/error.hpp"
#include "tests/bench/shapes.hpp"

namespace gnbv {
namespace {

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
    EXPECT_DOUBLE_EQ(shares.outside.at(0), 1.0 / shell(26));  // from 1.00 to 2.04 m
    EXPECT_DOUBLE_EQ(shares.raw.at(0), 1.0 / shell(26));
  }
}

TEST(SizedShares, OfABoxAreOfTheVoxelsWithTheirCentresInIt) {
  const std::vector<Vec3f> cloud = {{1.5F, 1.5F, 1.021F}, {1.5F, 1.5F, 2.019F}};
  // the lowest layer, a whole square of the shell, has its centres at 1.02 m
  const Box3 low(Vec3(0, 0, 1.0), Vec3(3, 3, 1.03));
  EXPECT_DOUBLE_EQ(shares_of(cube(), 0.04, cloud, low).outside.at(0), 1.0 / (26 * 26));
  const Box3 lower(Vec3(0, 0, 1.0), Vec3(3, 3, 1.019));
  EXPECT_EQ(shares_of(cube(), 0.04, cloud, lower).outside.at(0), 0.0);
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
  const SurfaceReference reference = make_surface_reference(world, RayScene(world), {}, 2);
  const std::vector<std::size_t> prefixes = {100, cloud.size()};
  const auto papers = coverage_of_prefixes(reference, cloud, prefixes, 2);
  EXPECT_GT(papers[1].outside[2], 0.5);
  for (std::size_t size = 0; size < 3; ++size) {
    const SizedShares ours =
        sized_shares(world, kCoverageSizes_m[size], {.floor_z_m = 0.3}, cloud, prefixes, 2);
    for (std::size_t i = 0; i < prefixes.size(); ++i) {
      EXPECT_NEAR(ours.raw[i], papers[i].raw[size], 1e-12) << size;
      EXPECT_NEAR(ours.outside[i], papers[i].outside[size], 1e-12) << size;
    }
  }
}

TEST(SizedRoom, IsRefusedByNameOfTheSizeThatFits) {
  TriangleMesh field;
  test::add_sheet(field, Vec3(0, 0, 1), Vec3(100, 0, 0), Vec3(0, 100, 0));
  const auto fault_of = [&](const std::vector<double>& sizes_m) -> std::string {
    try {
      need_room_for(sizes_m, field);
    } catch (const BadInput& fault) {
      return fault.what();
    }
    return "";
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
  const auto more = score_more_sizes(sizes_m, world, RayScene(world), 0.3, scored, 2);
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
