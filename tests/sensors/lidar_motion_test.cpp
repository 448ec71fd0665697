// Sweeps of a vehicle that moves, and the noise of their ranges.
#include <gtest/gtest.h>

#include <cstring>

#include "sensors/capture.hpp"
#include "tests/sensors/shapes.hpp"
#include "tests/sensors/statistics.hpp"

namespace gnbv {
namespace {

using test::add_sheet;
using test::add_wall;
using test::world_of;

LidarConfig rolling_lidar() { return {.beams = 721, .pitch_rad = 0.0, .rolling = true}; }

Isometry at(const Vec3& p_world_m, double yaw_rad = 0.0) {
  return T_world_body({p_world_m, yaw_rad});
}

/// Where the scan says that a beam ended.
Vec3 point_world_m(const LidarScan& scan, const LidarModel& lidar, std::size_t beam) {
  return scan.T_world_lidar *
         (static_cast<double>(scan.range_m[beam]) * lidar.beams_lidar[beam].cast<double>());
}

TEST(RollingScan, OfAMovingVehicleIsSkewedByItsSpeedTimesTheBeamsTime) {
  // flown sideways, 1 m/s to the left, past a wall ahead; then towards it
  const LidarModel lidar = make_lidar_model(rolling_lidar());
  const double duration_s = sweep_duration_s(lidar.config);
  EXPECT_DOUBLE_EQ(duration_s, 0.0125);  // 180 degrees at 40 Hz
  TriangleMesh room;
  add_wall(room, 6.0, -200, 200, -1, 1);
  add_sheet(room, {-50, -6, -1}, {100, 0, 0}, {0, 0, 2});
  add_sheet(room, {-50, 6, -1}, {100, 0, 0}, {0, 0, 2});
  const RayScene scene(world_of(room, false));
  for (const Vec3& v_m_s : {Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(-0.4, 0.7, 0)}) {
    const std::vector<Isometry> poses = {at(Vec3::Zero()), at(0.5 * duration_s * v_m_s),
                                         at(duration_s * v_m_s)};
    const LidarScan scan = capture_scan(scene, lidar, 2, poses, 0.5 * duration_s, {});
    EXPECT_EQ(scan.lidar, 2);
    EXPECT_EQ(scan.T_world_lidar.matrix(), at(Vec3::Zero()).matrix());
    for (std::size_t beam = 0; beam <= 720; ++beam) {
      const double t_s = duration_s * static_cast<double>(beam) / 720.0;
      const Vec3 seen_m = point_world_m(scan, lidar, beam) + t_s * v_m_s;
      // the true end of the beam lies on a wall: float rays of 6 to 9 m
      const double off_m = std::min(std::abs(seen_m.x() - 6.0), std::abs(std::abs(seen_m.y()) - 6));
      ASSERT_LT(off_m, 5e-6) << beam;
    }
    // the last beam looks left: its wall is 12.5 mm nearer after 12.5 ms at 1 m/s
    EXPECT_NEAR(scan.range_m.back(), 6.0 - 0.0125 * v_m_s.y(), 5e-6);
    EXPECT_NEAR(scan.range_m.front(), 6.0, 5e-6);
    EXPECT_NEAR(scan.range_m[360], 6.0 - 0.00625 * v_m_s.x(), 5e-6);
  }
}

TEST(RollingScan, OfAStillVehicleIsTheInstantScan) {
  LidarConfig config = rolling_lidar();
  const RayScene scene(world_of(test::random_soup(300, 5.0, {6, 0, 0}, 5), true));
  const Isometry pose = at({-3, 1, 2}, 0.3);
  const std::vector<Isometry> poses(6, pose);
  const LidarScan rolling = capture_scan(scene, make_lidar_model(config), 0, poses, 0.004, {});
  config.rolling = false;
  EXPECT_EQ(sweep_duration_s(config), 0.0);
  const LidarScan instant = capture_scan(scene, make_lidar_model(config), 0, {&pose, 1}, 0.0, {});
  EXPECT_EQ(std::memcmp(rolling.range_m.data(), instant.range_m.data(),
                        instant.range_m.size() * sizeof(float)),
            0);
}

TEST(RollingScan, OfATurningVehicleIsTwistedAndBeamsFollowThePosesTheyAreGiven) {
  const LidarModel lidar = make_lidar_model(rolling_lidar());
  const double duration_s = sweep_duration_s(lidar.config);
  TriangleMesh wall;
  add_sheet(wall, {-50, 6, -1}, {100, 0, 0}, {0, 0, 2});
  add_wall(wall, 6.0, -200, 6, -1, 1);
  const RayScene scene(world_of(wall, false));
  const auto azimuth_rad = [](double beam) { return deg_to_rad(-90.0 + 0.25 * beam); };
  const double turn_rad = deg_to_rad(1.0);
  const LidarScan turned = capture_scan(
      scene, lidar, 0, {{at(Vec3::Zero()), at(Vec3::Zero(), turn_rad)}}, duration_s, {});
  for (std::size_t beam = 60; beam <= 530; ++beam) {
    const auto b = static_cast<double>(beam);
    const double expected_m = 6.0 / std::cos(azimuth_rad(b) + turn_rad * b / 720.0);
    ASSERT_NEAR(turned.range_m[beam], expected_m, 3e-6 * expected_m) << beam;  // slant up to 1:4
  }
  // a kink between even poses: the beams on either side of it see two speeds
  const std::vector<Isometry> poses = {at({0, 0, 0}), at({0.1, 0, 0}), at({0.1, 0, 0}),
                                       at({0.1, 0.3, 0})};
  const LidarScan scan = capture_scan(scene, lidar, 0, poses, duration_s / 3.0, {});
  EXPECT_NEAR(scan.range_m.back(), 5.7, 5e-6);
  EXPECT_NEAR(scan.range_m[360], 5.9, 5e-6);
  // half way to the second pose
  EXPECT_NEAR(scan.range_m[120], (6.0 - 0.05) / std::cos(azimuth_rad(120)), 1e-5);
}

TEST(RangeNoise, IsNormalWithItsSigma) {
  // 721 beams, 50 ticks: 5 % of sigma would be 13 deviations of the variance
  LidarConfig config = rolling_lidar();
  config.rolling = false;
  config.range_sigma_m = 0.03;
  const RayScene scene(world_of(test::sphere({0, 0, 0}, 8.0), false));
  const Isometry pose = Isometry::Identity();
  const LidarModel noisy = make_lidar_model(config);
  config.range_sigma_m = 0.0;
  const LidarModel exact = make_lidar_model(config);
  const LidarScan truth = capture_scan(scene, exact, 0, {&pose, 1}, 0.0, {});
  std::vector<double> sample;
  for (std::uint64_t tick = 0; tick < 50; ++tick) {
    const LidarScan scan = capture_scan(scene, noisy, 0, {&pose, 1}, 0.0, {9, tick});
    for (std::size_t i = 0; i < scan.range_m.size(); ++i) {
      sample.push_back((scan.range_m[i] - truth.range_m[i]) / 0.03);
    }
  }
  EXPECT_TRUE(test::is_standard(sample));
}

TEST(RangeNoise, IsKeyedBySeedTickAndLidar) {
  const LidarModel lidar = make_lidar_model({.range_sigma_m = 0.01});
  const RayScene scene(world_of(test::sphere({0, 0, 0}, 8.0), false));
  const Isometry pose = Isometry::Identity();
  const auto ranges = [&](int index, const NoiseKey& key) {
    return capture_scan(scene, lidar, index, {&pose, 1}, 0.0, key).range_m;
  };
  const std::vector<float> first = ranges(0, {1, 2});
  EXPECT_EQ(first, ranges(0, {1, 2}));
  // readings of 8 +- 0.01 m are of some 20,000 floats: two in 720 may agree, not ten
  EXPECT_LT(test::agreement(first, ranges(0, {2, 2})), 10.0 / 720);
  EXPECT_LT(test::agreement(first, ranges(0, {1, 3})), 10.0 / 720);
  EXPECT_LT(test::agreement(first, ranges(1, {1, 2})), 10.0 / 720);
}

TEST(RangeNoise, KeepsTheLawsOfNearAndFar) {
  LidarConfig config = rolling_lidar();
  config.range_sigma_m = 0.2;
  config.range_min_m = 4.0;
  config.range_max_m = 8.0;
  const LidarModel lidar = make_lidar_model(config);
  const Isometry pose = Isometry::Identity();
  const auto count = [&](double radius_m, const auto& kind) {
    const RayScene scene(world_of(test::sphere({0, 0, 0}, radius_m), false));
    const LidarScan scan = capture_scan(scene, lidar, 0, {&pose, 1}, 0.0, {});
    return std::count_if(scan.range_m.begin(), scan.range_m.end(), kind);
  };
  const auto is_invalid = [](float r) { return std::isnan(r); };
  const auto is_no_return = [](float r) { return r == kNoReturn; };
  EXPECT_EQ(count(3.99, is_invalid), 721);  // too near is never read
  // half of the readings of a surface at the border lie beyond it, to four binomial deviations
  EXPECT_NEAR(static_cast<double>(count(4.002, is_invalid)), 360, 54);
  EXPECT_EQ(count(4.002, is_no_return), 0);
  EXPECT_NEAR(static_cast<double>(count(8.002, is_no_return)), 360, 54);
  EXPECT_EQ(count(8.002, is_invalid), 0);
  EXPECT_EQ(count(9.5, is_no_return), 721);  // 7.5 deviations
}

}  // namespace
}  // namespace gnbv
