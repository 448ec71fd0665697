#include "bench/score/voxel_set.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "sim/core/error.hpp"
#include "sim/core/rng.hpp"

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

TEST(VoxelSet, IsSortedAndUnique) {
  const VoxelSet set = voxels_of(random_points(20000, 3), 0.5);
  EXPECT_TRUE(std::is_sorted(set.begin(), set.end()));
  EXPECT_EQ(std::adjacent_find(set.begin(), set.end()), set.end());
  EXPECT_GE(set.size(), 8U * 8U * 8U);  // [-2, 2) is eight voxels, 2 the first point of a ninth
  EXPECT_LE(set.size(), 9U * 9U * 9U);
}

TEST(VoxelSet, NamesThePointThatHasNoVoxel) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(),
                          std::numeric_limits<float>::infinity(), 1e6F, -1e6F}) {
    std::vector<Vec3f> points = random_points(5, 4);
    points[3].y() = bad;
    try {
      voxels_of(points, 0.05);
      FAIL() << "accepted " << bad;
    } catch (const BadInput& error) {
      EXPECT_NE(std::string(error.what()).find("point 3"), std::string::npos) << error.what();
    }
    EXPECT_THROW(voxel_code(points[3], 0.05), BrokenInvariant);
  }
}

TEST(Coverage, EqualsTheShareCountedWithSets) {
  const VoxelSet reference = voxels_of(random_points(3000, 5), 0.1);
  const VoxelSet cloud = voxels_of(random_points(3000, 6), 0.1);
  const std::set<std::uint64_t> in_cloud(cloud.begin(), cloud.end());
  std::size_t covered = 0;
  for (const std::uint64_t voxel : reference) covered += in_cloud.count(voxel);
  ASSERT_GT(covered, 0U);
  ASSERT_LT(covered, reference.size());
  EXPECT_EQ(coverage(reference, cloud),
            static_cast<double>(covered) / static_cast<double>(reference.size()));
}

TEST(Coverage, NothingCoversNothing) {
  const VoxelSet some = voxels_of(random_points(10, 7), 0.1);
  EXPECT_EQ(coverage(some, {}), 0.0);
  EXPECT_EQ(coverage({}, some), 0.0);
  EXPECT_EQ(coverage(some, some), 1.0);
}

TEST(Coverage, NeverFallsWithMorePoints) {
  const VoxelSet reference = voxels_of(random_points(3000, 8), 0.1);
  const std::vector<Vec3f> points = random_points(3000, 9);
  double last = 0.0;
  for (std::size_t n = 0; n <= points.size(); n += 100) {
    const double now = coverage(reference, voxels_of(std::span(points).first(n), 0.1));
    EXPECT_GE(now, last);
    last = now;
  }
  EXPECT_GT(last, 0.0);
}

}  // namespace
}  // namespace gnbv
