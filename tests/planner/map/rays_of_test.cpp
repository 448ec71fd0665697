#include <gtest/gtest.h>

#include "bench/reference/depth_rays.hpp"
#include "planner/map/scan_insertion.hpp"
#include "sim/core/error.hpp"

namespace gnbv {
namespace {

constexpr double kFloor_m = 0.3;

CameraModel small_camera() {
  CameraConfig config;
  config.width_px = 4;
  config.height_px = 2;
  return make_camera_model(config);
}

DepthFrame frame_of(const CameraModel& camera, float depth_m) {
  DepthFrame frame;
  frame.T_world_camera = T_world_body({Vec3(1, 2, 5), deg_to_rad(30.0)}) * camera.T_body_camera;
  frame.depth_m.assign(8, depth_m);
  return frame;
}

Vec3 in_camera(const DepthFrame& frame, const ScanRay& ray) {
  return frame.T_world_camera.inverse() * ray.end_world_m.cast<double>();
}

// float32 coordinates below 16 m are rounded by up to 5e-7
constexpr double kFloatSlack_m = 1e-6;

TEST(RaysOf, ReturnsLieAtTheirDepthAlongTheirPixelsRay) {
  const CameraModel camera = small_camera();
  const DepthFrame frame = frame_of(camera, 3.0F);
  const std::vector<ScanRay> rays = rays_of(frame, camera, kFloor_m);
  ASSERT_EQ(rays.size(), 8U);
  for (int v = 0; v < 2; ++v) {
    for (int u = 0; u < 4; ++u) {
      const ScanRay& ray = rays[static_cast<std::size_t>(4 * v + u)];
      EXPECT_TRUE(ray.hit);
      const Vec3 expected_m = 3.0 * camera.ray_camera(u, v).cast<double>();
      EXPECT_LT((in_camera(frame, ray) - expected_m).norm(), 2.0 * kFloatSlack_m);
    }
  }
}

TEST(RaysOf, NoReturnClearsToThePlaneAtMaximumRange) {
  const CameraModel camera = small_camera();
  for (const float depth_m : {kNoReturn, 8.1F}) {
    const DepthFrame frame = frame_of(camera, depth_m);
    const std::vector<ScanRay> rays = rays_of(frame, camera, kFloor_m);
    ASSERT_EQ(rays.size(), 8U);
    for (const ScanRay& ray : rays) {
      EXPECT_FALSE(ray.hit);
      EXPECT_NEAR(in_camera(frame, ray).z(), 8.0, kFloatSlack_m);  // a plane, not a sphere
    }
  }
}

TEST(RaysOf, InvalidOrTooNearGivesNoRay) {
  const CameraModel camera = small_camera();
  for (const float depth_m : {kInvalidRange, 0.29F, 0.0F, -1.0F}) {
    EXPECT_TRUE(rays_of(frame_of(camera, depth_m), camera, kFloor_m).empty()) << depth_m;
  }
  EXPECT_EQ(rays_of(frame_of(camera, 0.3F), camera, kFloor_m).size(), 8U);
  EXPECT_EQ(rays_of(frame_of(camera, 8.0F), camera, kFloor_m).size(), 8U);
}

TEST(RaysOf, TheFloorClearsButMarksNothing) {
  const CameraModel camera = small_camera();
  const DepthFrame frame = frame_of(camera, 4.0F);
  for (const ScanRay& ray : rays_of(frame, camera, 5.0)) {  // the horizon is the floor
    EXPECT_EQ(ray.hit, ray.end_world_m.z() > 5.0F);
  }
  EXPECT_EQ(rays_of(frame, camera, 100.0).size(), 8U);
}

TEST(RaysOf, RefusesAFrameOfAnotherSize) {
  const CameraModel camera = small_camera();
  DepthFrame frame = frame_of(camera, 4.0F);
  frame.depth_m.pop_back();
  EXPECT_THROW(rays_of(frame, camera, kFloor_m), BrokenInvariant);
}

TEST(RaysOf, LidarRangesAreSpherical) {
  LidarConfig lidar;
  lidar.beams = 5;
  LidarScan scan;
  scan.T_world_lidar = T_world_body({Vec3(1, 2, 20), 0.3}) * T_body_lidar(lidar);
  scan.range_m = {kNoReturn, kInvalidRange, 7.0F, 31.0F, 0.05F};
  const std::vector<ScanRay> rays = rays_of(scan, make_lidar_model(lidar), kFloor_m);
  ASSERT_EQ(rays.size(), 3U);
  const std::array<double, 3> range_m = {30.0, 7.0, 30.0};
  const std::array<int, 3> beam = {0, 2, 3};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 expected_m =
        scan.T_world_lidar * (range_m[i] * beam_lidar(lidar, beam[i]).cast<double>());
    // float32 coordinates below 64 m
    EXPECT_LT((rays[i].end_world_m.cast<double>() - expected_m).norm(), 5e-6);
    EXPECT_EQ(rays[i].hit, i == 1);
  }
}

}  // namespace
}  // namespace gnbv
