#include "bench/score/coverage_curve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "sim/core/error.hpp"
#include "tests/bench/shapes.hpp"

namespace gnbv {
namespace {

SurfaceReference box_in_a_box() {
  World world;
  test::add_box(world.structure, Vec3(-1, -1, 0.5), Vec3(2, 2, 2));
  test::add_box(world.structure, Vec3(-0.6, -0.6, 0.9), Vec3(1.2, 1.2, 1.2));
  return make_surface_reference(world, RayScene(world), {}, 2);
}

std::vector<Vec3f> random_points(std::size_t count) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> coordinate(-1.2F, 1.2F);
  std::vector<Vec3f> points;
  for (std::size_t i = 0; i < count; ++i) {
    points.emplace_back(coordinate(random), coordinate(random), 1.5F + coordinate(random));
  }
  return points;
}

TEST(CoverageOfPrefixes, EqualsTheSetsOfEachPrefix) {
  const SurfaceReference reference = box_in_a_box();
  const std::vector<Vec3f> cloud = random_points(20000);
  const std::vector<std::size_t> prefixes = {0, 1, 10, 10, 500, 4999, 20000};
  for (const int threads : {1, 3}) {
    const auto shares = coverage_of_prefixes(reference, cloud, prefixes, threads);
    ASSERT_EQ(shares.size(), prefixes.size());
    for (std::size_t i = 0; i < prefixes.size(); ++i) {
      const std::span<const Vec3f> prefix = std::span(cloud).first(prefixes[i]);
      EXPECT_EQ(shares[i].raw, coverage_at_all_sizes(reference.raw, prefix)) << i;
      EXPECT_EQ(shares[i].outside, coverage_at_all_sizes(reference.outside, prefix)) << i;
    }
    EXPECT_EQ(shares.front().raw, (std::array<double, 3>{}));
    EXPECT_GT(shares.back().raw[0], 0.1);
    EXPECT_NE(shares.back().raw[0], shares.back().outside[0]);
  }
}

TEST(CoverageMeter, EqualsTheSetsOfTheCloudAsItGrows) {
  const SurfaceReference reference = box_in_a_box();
  const std::vector<Vec3f> cloud = random_points(20000);
  for (const std::size_t size : {0U, 2U}) {
    CoverageMeter meter(reference.outside[size], kCoverageSizes_m[size]);
    for (const std::size_t count : {0U, 10U, 10U, 5000U, 20000U}) {
      const std::span<const Vec3f> grown = std::span(cloud).first(count);
      EXPECT_EQ(meter.share_of(grown), coverage_at_all_sizes(reference.outside, grown)[size]);
    }
  }
}

TEST(CoverageOfPrefixes, OfAnEmptyReferenceIsZero) {
  const std::vector<Vec3f> cloud = random_points(10);
  const std::vector<std::size_t> prefixes = {10};
  EXPECT_EQ(coverage_of_prefixes({}, cloud, prefixes, 1)[0].raw, (std::array<double, 3>{}));
}

TEST(CoverageOfPrefixes, RefusesPrefixesThatShrinkOrEndBeyondTheCloud) {
  const std::vector<Vec3f> cloud = random_points(10);
  const std::vector<std::size_t> shrinking = {5, 4};
  const std::vector<std::size_t> beyond = {11};
  EXPECT_THROW(coverage_of_prefixes({}, cloud, shrinking, 1), BrokenInvariant);
  EXPECT_THROW(coverage_of_prefixes({}, cloud, beyond, 1), BrokenInvariant);
}

TEST(ReferencePoints, OneLiesInEachVoxelSeenFromOutsideInItsOrder) {
  const SurfaceReference reference = box_in_a_box();
  ASSERT_EQ(reference.points_world_m.size(), reference.outside[0].size());
  for (std::size_t i = 0; i < reference.points_world_m.size(); ++i) {
    ASSERT_EQ(voxel_code(reference.points_world_m[i], kCoverageSizes_m[0]),
              reference.outside[0][i]);
    // on the outer box, never on the inner one
    const Vec3f from_centre_m = reference.points_world_m[i] - Vec3f(0, 0, 1.5F);
    ASSERT_NEAR(from_centre_m.cwiseAbs().maxCoeff(), 1.0F, 1e-5F);
  }
}

TEST(ReferenceSamples, StandForEqualAreasOfWhatSeesOut) {
  // the part of the outer box above the floor: a lid of 4 m2, walls of 2 m x 2 m and a bottom; any
  // tenth of a wall's height has a tenth of the wall's samples, whatever its triangles are
  World world;
  test::add_box(world.structure, Vec3(-1, -1, 0.5), Vec3(2, 2, 2));
  test::add_box(world.structure, Vec3(-0.6, -0.6, 0.9), Vec3(1.2, 1.2, 1.2));
  const SurfaceReference reference = make_surface_reference(world, RayScene(world), {}, 2);
  const auto all = static_cast<double>(reference.samples_world_m.size());
  EXPECT_NEAR(all, kAreaSamples, 0.25 * kAreaSamples);
  for (int tenth = 0; tenth < 10; ++tenth) {
    const auto low_m = static_cast<float>(0.5 + 0.2 * tenth);
    const auto in_tenth = std::count_if(
        reference.samples_world_m.begin(), reference.samples_world_m.end(), [&](const Vec3f& p_m) {
          return p_m.x() > 0.9999F && p_m.z() >= low_m && p_m.z() < low_m + 0.2F;
        });
    EXPECT_NEAR(static_cast<double>(in_tenth) / all, 0.4 / 24.0, 0.02 * 0.4 / 24.0) << tenth;
  }
  for (const Vec3f& p_m : reference.samples_world_m) {
    ASSERT_NEAR((p_m - Vec3f(0, 0, 1.5F)).cwiseAbs().maxCoeff(), 1.0F, 1e-5F);
  }
}

TEST(ReferencePoints, OfADoubleWallLieOnTheOuterOne) {
  // both walls in the same voxels, the hidden one through their middle
  World world;
  test::add_box(world.structure, Vec3(-1.04, -1.04, 0.46), Vec3(2.08, 2.08, 2.08));
  test::add_box(world.structure, Vec3(-1.02, -1.02, 0.48), Vec3(2.04, 2.04, 2.04));
  const SurfaceReference reference = make_surface_reference(world, RayScene(world), {}, 2);
  ASSERT_FALSE(reference.points_world_m.empty());
  for (const Vec3f& p_m : reference.points_world_m) {
    ASSERT_NEAR((p_m - Vec3f(0, 0, 1.5F)).cwiseAbs().maxCoeff(), 1.04F, 1e-5F);
  }
}

}  // namespace
}  // namespace gnbv
