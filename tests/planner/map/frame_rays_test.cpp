#include <gtest/gtest.h>

#include <bit>

#include "bench/reference/depth_rays.hpp"
#include "planner/map/scan_rays.hpp"
#include "sim/core/error.hpp"
#include "tests/planner/map/frames.hpp"
#include "tests/support/at_simd_level.hpp"

namespace gnbv {
namespace {

const Box3 kBox_m(Vec3(-20, -20, 0), Vec3(20, 20, 20));

/// The pixels that say something, as rays_of gives them.
std::vector<ScanRay> compact(const FrameRays& rays) {
  std::vector<ScanRay> each;
  for (std::size_t i = 0; i < rays.kind.size(); ++i) {
    if (rays.kind[i] == PixelRay::none) continue;
    each.push_back({rays.end_world_m(i), rays.kind[i] == PixelRay::hits});
  }
  return each;
}

void expect_same_bits(const Vec3f& a, const Vec3f& b) {
  for (int axis = 0; axis < 3; ++axis) {
    ASSERT_EQ(std::bit_cast<std::uint32_t>(a[axis]), std::bit_cast<std::uint32_t>(b[axis]));
  }
}

class FrameRaysAt : public AtSimdLevel {};

TEST_P(FrameRaysAt, EqualRaysOfBitForBitAtEveryWidth) {
  Random random(5);
  FrameRays rays;  // reused: a small frame after a large one
  for (const int width_px : {64, 37, 16, 15, 3, 1}) {
    CameraModel camera = camera_of(width_px, 11, 60.0, 45.0);
    for (const double range_max_m : {8.0, 8.1}) {  // 8.1 is more than 8.1 as float32
      camera.config.range_max_m = range_max_m;
      DepthFrame frame;
      frame.T_world_camera = random_pose(random, kBox_m);
      frame.depth_m = noise_depths(random, camera);
      frame.depth_m.front() = static_cast<float>(range_max_m);
      frame.depth_m.back() = 0.3F;
      const double floor_z_m = frame.T_world_camera.translation().z() - 0.5;
      const std::vector<ScanRay> expected = rays_of(frame, camera, floor_z_m);
      compute_frame_rays(frame, camera, floor_z_m, rays);
      ASSERT_EQ(rays.end_m[0].size(), frame.depth_m.size());
      const std::vector<ScanRay> each = compact(rays);
      ASSERT_EQ(each.size(), expected.size());
      for (std::size_t i = 0; i < each.size(); ++i) {
        expect_same_bits(each[i].end_world_m, expected[i].end_world_m);
        ASSERT_EQ(each[i].hit, expected[i].hit);
      }
      expect_same_bits(rays.origin_world_m,
                       Vec3f(frame.T_world_camera.translation().cast<float>()));
    }
  }
}

GNBV_AT_EVERY_SIMD_LEVEL(FrameRaysAt);

TEST(FrameRays, RefuseAFrameOfAnotherSize) {
  const CameraModel camera = camera_of(4, 2, 60.0, 45.0);
  DepthFrame frame;
  frame.depth_m.assign(7, 1.0F);
  FrameRays rays;
  EXPECT_THROW(compute_frame_rays(frame, camera, 0.0, rays), BrokenInvariant);
}

}  // namespace
}  // namespace gnbv
