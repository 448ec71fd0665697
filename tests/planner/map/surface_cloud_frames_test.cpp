// The cloud by frames, at every SIMD level, restored from its points, and in large workspaces.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "planner/map/surface_cloud.hpp"
#include "tests/planner/map/random_points.hpp"
#include "tests/support/at_simd_level.hpp"

namespace gnbv {
namespace {

const Box3 kBox_m(Vec3(-2, -2, 0), Vec3(2, 2, 2));

class SurfaceCloudAt : public AtSimdLevel {};

/// Pixels in the box and a little beyond it, many on leaf borders, some on the box's faces.
FrameRays random_frame(Random& random, const Box3& box_m, double leaf_m, std::size_t pixels) {
  const Vec3 beyond_m = Vec3::Constant(0.3);
  const Box3 around_m(box_m.min() - beyond_m, box_m.max() + beyond_m);
  const Vec3f corner_m = random.point_in(box_m);
  FrameRays frame;
  for (std::size_t i = 0; i < pixels; ++i) {
    Vec3f p_m = random.chance(0.3)
                    ? random.point_in(around_m)
                    : corner_m + random.point_in(Box3(Vec3::Zero(), Vec3(0.5, 0.5, 0.02)));
    const int axis = static_cast<int>(random.uniform(0.0, 3.0));
    const auto a = static_cast<Eigen::Index>(axis);
    if (random.chance(0.3)) {
      p_m[a] = static_cast<float>(std::round(static_cast<double>(p_m[a]) / leaf_m) * leaf_m);
    }
    if (random.chance(0.05)) {
      const float face_m = static_cast<float>(random.chance(0.5) ? box_m.min()[a] : box_m.max()[a]);
      const float to_m = random.chance(0.5) ? 1e9F : -1e9F;
      p_m[a] = random.chance(0.3) ? face_m : std::nextafter(face_m, to_m);
    }
    if (random.chance(0.01)) p_m[a] = std::numeric_limits<float>::quiet_NaN();
    for (int column = 0; column < 3; ++column) frame.end_m[column].push_back(p_m[column]);
    frame.kind.push_back(random.chance(0.7)   ? PixelRay::hits
                         : random.chance(0.5) ? PixelRay::clears
                                              : PixelRay::none);
  }
  return frame;
}

std::vector<Vec3f> hits_of(std::span<const FrameRays> frames) {
  std::vector<Vec3f> hits_m;
  for (const FrameRays& frame : frames) {
    for (std::size_t i = 0; i < frame.kind.size(); ++i) {
      if (frame.kind[i] != PixelRay::hits) continue;
      hits_m.push_back(frame.end_world_m(i));
    }
  }
  return hits_m;
}

void expect_equal(const SurfaceCloud& a, const SurfaceCloud& b, const GridGeometry& grid) {
  ASSERT_TRUE(std::ranges::equal(a.points_world_m(), b.points_world_m()));
  for (VoxelIndex v = 0; v < grid.voxel_count(); ++v) {
    ASSERT_EQ(a.point_count(v), b.point_count(v)) << v;
    ASSERT_EQ(a.neighbour_sum(v), b.neighbour_sum(v)) << v;
  }
}

TEST_P(SurfaceCloudAt, FramesGiveWhatTheirPointsGive) {
  struct Case {
    Box3 box_m;
    double voxel_m, leaf_m;
  };
  const Box3 corridor_m(Vec3(-3000, -1, 0), Vec3(3200, 1, 1));  // 31,000 voxels long
  for (const auto& [box_m, voxel_m, leaf_m] : std::vector<Case>{{kBox_m, 0.2, 0.02},
                                                                {kBox_m, 0.17, 0.025},
                                                                {kBox_m, 0.05, 0.06},
                                                                {kBox_m, 0.2, 0.2 / 63},
                                                                {corridor_m, 0.2, 0.02},
                                                                {corridor_m, 0.2, 0.2 / 61}}) {
    const GridGeometry grid(box_m, voxel_m);
    SurfaceCloud by_points({.leaf_m = leaf_m, .profile_leaf_m = 0.1}, grid);
    SurfaceCloud by_frames = by_points;
    Random random(47);
    for (int batch = 0; batch < 4; ++batch) {
      // longer than what is looked at in one piece, and not a multiple of any vector
      const std::vector<FrameRays> frames = {random_frame(random, box_m, leaf_m, 9005),
                                             random_frame(random, box_m, leaf_m, 333)};
      set_simd_level(SimdLevel::baseline);
      const std::size_t gained = by_points.add(hits_of(frames), leaf_m);
      set_simd_level(GetParam());
      ASSERT_EQ(by_frames.add(frames), gained) << "batch " << batch;
      if (batch == 1) {  // a profile comes between
        for (SurfaceCloud* const cloud : {&by_points, &by_frames}) cloud->add(hits_of(frames), 0.1);
      }
    }
    EXPECT_GT(by_points.points_world_m().size(), 5000U);
    expect_equal(by_frames, by_points, grid);
  }
}

TEST_P(SurfaceCloudAt, APointAtExactlyTheRadiusCounts) {
  const GridGeometry grid(Box3(Vec3(-8, -8, 0), Vec3(8, 8, 8)), 2.0);  // radius^2 2
  SurfaceCloud cloud({.leaf_m = 0.25, .profile_leaf_m = 0.25}, grid);
  cloud.add(std::vector<Vec3f>{Vec3f(0.5F, 0.5F, 0.5F), Vec3f(1.5F, 1.5F, 0.5F)}, 0.25);
  EXPECT_EQ(cloud.neighbour_sum(grid.index_of(grid.key_of(Vec3(1, 1, 1)))), 4U);
  const float beyond_m = std::nextafter(1.5F, 2.0F);
  SurfaceCloud apart({.leaf_m = 0.25, .profile_leaf_m = 0.25}, grid);
  apart.add(std::vector<Vec3f>{Vec3f(0.5F, 0.5F, 0.5F), Vec3f(beyond_m, 1.5F, 0.5F)}, 0.25);
  EXPECT_EQ(apart.neighbour_sum(grid.index_of(grid.key_of(Vec3(1, 1, 1)))), 2U);
}

GNBV_AT_EVERY_SIMD_LEVEL(SurfaceCloudAt);

TEST(SurfaceCloud, RestoredFromItsPointsItIsTheSameAndStaysSo) {
  const GridGeometry grid(kBox_m, 0.17);
  const CloudConfig config{.leaf_m = 0.025, .profile_leaf_m = 0.1};
  SurfaceCloud cloud(config, grid);
  Random random(53);
  cloud.add(random_sheet(random, kBox_m, 4000), 0.1);
  cloud.add(random_sheet(random, kBox_m, 4000), 0.025);
  SurfaceCloud restored(config, grid);
  ASSERT_TRUE(restored.restore(cloud.points_world_m()));
  expect_equal(restored, cloud, grid);
  const std::vector<Vec3f> more = random_sheet(random, kBox_m, 4000);
  EXPECT_EQ(restored.add(more, 0.025), cloud.add(more, 0.025));
  expect_equal(restored, cloud, grid);
}

TEST(SurfaceCloud, IsNotRestoredFromOtherPoints) {
  const GridGeometry grid(kBox_m, 0.2);
  const auto can_restore = [&](const std::vector<Vec3f>& points_m) {
    return SurfaceCloud(CloudConfig{}, grid).restore(points_m);
  };
  EXPECT_TRUE(can_restore({Vec3f(0.11F, 0, 1), Vec3f(0.13F, 0, 1)}));
  EXPECT_FALSE(can_restore({Vec3f(0.11F, 0, 1), Vec3f(0.115F, 0, 1)}));
  EXPECT_FALSE(can_restore({Vec3f(2.1F, 0, 1)}));
  EXPECT_FALSE(can_restore({Vec3f(std::numeric_limits<float>::quiet_NaN(), 0, 1)}));
}

std::size_t resident_bytes() {
  std::size_t program_pages = 0;
  std::size_t resident_pages = 0;
  std::ifstream("/proc/self/statm") >> program_pages >> resident_pages;
  return resident_pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

TEST(SurfaceCloud, TakesMemoryWhereThePointsAreOnly) {
  const GridGeometry grid(Box3(Vec3(-20, -20, 0), Vec3(20, 20, 20)), 0.05);  // 256 million voxels
  [[maybe_unused]] const std::size_t before = resident_bytes();
  SurfaceCloud cloud(CloudConfig{}, grid);
  Random random(59);
  cloud.add(random_sheet(random, kBox_m, 4000), 0.02);
  EXPECT_GT(cloud.points_world_m().size(), 1000U);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // theirs grows with addresses
  EXPECT_LT(resident_bytes() - before, std::size_t{64} << 20);
#endif
  EXPECT_EQ(cloud.density(0), 0.0);
}

}  // namespace
}  // namespace gnbv
