#include <gtest/gtest.h>

#include "sensors/capture.hpp"
#include "tests/sensors/shapes.hpp"

namespace gnbv {
namespace {

using test::add_wall;
using test::world_of;

/// One beam exactly forward: an odd number of them.
LidarConfig lidar_with(double pitch_rad) {
  LidarConfig config;
  config.beams = 721;
  config.pitch_rad = pitch_rad;
  return config;
}
constexpr std::size_t kForward = 360;

/// A sweep from one place.
LidarScan sweep(const RayScene& scene, const LidarConfig& lidar, const Isometry& T_world_body,
                const NoiseKey& key = {}) {
  return capture_scan(scene, make_lidar_model(lidar), 0, {&T_world_body, 1}, 0.0, key);
}

TEST(LidarCapture, DefaultTiltPointsTheFanDownTenDegrees) {
  const RayScene scene(world_of({}, true));
  const LidarConfig lidar = lidar_with(LidarConfig{}.pitch_rad);
  const LidarScan scan = sweep(scene, lidar, T_world_body({{3, 4, 2.0}, 1.1}));
  for (int beam = 0; beam < lidar.beams; ++beam) {
    const double azimuth_rad = deg_to_rad(-90.0 + 0.25 * beam);
    const double expected_m = 2.0 / (std::sin(deg_to_rad(10.0)) * std::cos(azimuth_rad));
    const float range_m = scan.range_m[static_cast<std::size_t>(beam)];
    if (expected_m < 29.9) {
      ASSERT_NEAR(range_m, expected_m, 1e-5 * expected_m) << beam;  // float rays, slant up to 1:15
    } else if (expected_m > 30.1 || azimuth_rad < -1.57 || azimuth_rad > 1.57) {
      ASSERT_EQ(range_m, kNoReturn) << beam;
    }
  }
}

TEST(LidarCapture, BeamsRunCounterClockwiseFromTheRight) {
  TriangleMesh panels;  // 1 m wide: right at 2 m, ahead at 3 m, left at 4 m
  test::add_rectangle(panels, {-0.5, -2, -1}, {1, 0, 0}, {0, 0, 2});
  add_wall(panels, 3.0, -0.5, 0.5, -1, 1);
  test::add_rectangle(panels, {-0.5, 4, -1}, {1, 0, 0}, {0, 0, 2});
  const RayScene scene(world_of(panels, false));
  const LidarScan scan = sweep(scene, lidar_with(0.0), Isometry::Identity());
  ASSERT_EQ(scan.range_m.size(), 721U);
  EXPECT_NEAR(scan.range_m.front(), 2.0, 1e-5);
  EXPECT_NEAR(scan.range_m[kForward], 3.0, 1e-5);
  EXPECT_NEAR(scan.range_m.back(), 4.0, 1e-5);
  EXPECT_EQ(scan.range_m[kForward / 2], kNoReturn);
}

TEST(LidarCapture, RangesAreSphericalUpToTheMaximum) {
  TriangleMesh wall;
  add_wall(wall, 20.0, -100, 100, -100, 100);
  const RayScene scene(world_of(wall, false));
  const LidarConfig lidar = lidar_with(0.0);
  const LidarScan scan = sweep(scene, lidar, Isometry::Identity());
  int returns = 0;
  for (int beam = 0; beam < lidar.beams; ++beam) {
    const double cosine = std::cos(deg_to_rad(-90.0 + 0.25 * beam));
    const float range_m = scan.range_m[static_cast<std::size_t>(beam)];
    if (20.0 > 30.0 * cosine) {  // 48.19 degrees: between two beams, far from both
      ASSERT_EQ(range_m, kNoReturn) << beam;
    } else {
      ASSERT_NEAR(range_m, 20.0 / cosine, 1e-4) << beam;  // 3e-6 relative, float
      ++returns;
    }
  }
  EXPECT_EQ(returns, 2 * 192 + 1);  // floor(48.19 / 0.25) to each side, and the one ahead
}

TEST(LidarCapture, TooNearASurfaceIsInvalidAndHides) {
  TriangleMesh walls;
  add_wall(walls, 0.05, -0.01, 0.01, -1, 1);
  add_wall(walls, 3.0, -50, 50, -1, 1);
  const RayScene scene(world_of(walls, false));
  const LidarScan scan = sweep(scene, lidar_with(0.0), Isometry::Identity());
  EXPECT_TRUE(std::isnan(scan.range_m[kForward]));
  EXPECT_NEAR(scan.range_m[kForward + 120], 3.0 / std::cos(deg_to_rad(30.0)), 1e-5);
}

TEST(LidarCapture, EqualsBruteForceAtEveryBeam) {
  const TriangleMesh soup = test::random_soup(60, 3.0, {0, 0, 0}, 23);
  const RayScene scene(world_of(soup, false));
  LidarConfig lidar;
  lidar.p_body_m = {0.1, 0.0, -0.05};
  const LidarScan scan = sweep(scene, lidar, T_world_body({{-4, 0.5, 1}, 0.2}));
  int compared = 0;
  for (int beam = 0; beam < lidar.beams; ++beam) {
    const Vec3 direction = scan.T_world_lidar.linear() * beam_lidar(lidar, beam).cast<double>();
    const test::BruteHit expected =
        test::brute_first_hit(soup, scan.T_world_lidar.translation(), direction);
    if (expected.is_near_edge) continue;
    const float range_m = scan.range_m[static_cast<std::size_t>(beam)];
    if (std::isinf(expected.distance)) {
      ASSERT_EQ(range_m, kNoReturn) << beam;
    } else {
      ASSERT_NEAR(range_m, expected.distance, 5e-5) << beam;  // float rays under a slant
    }
    ++compared;
  }
  EXPECT_GT(compared, 690);
}

}  // namespace
}  // namespace gnbv
