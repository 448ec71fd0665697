#include "planner/map/ray_walk.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

#include "bench/reference/analytic_scans.hpp"
#include "bench/reference/octomap_twin.hpp"
#include "planner/map/scan_rays.hpp"
#include "sim/core/error.hpp"
#include "tests/planner/map/frames.hpp"
#include "tests/planner/map/random_points.hpp"
#include "tests/support/at_simd_level.hpp"

namespace gnbv {
namespace {

const Box3 kBox_m(Vec3(-4, -3, -1), Vec3(4, 3, 3));

std::vector<Key> walked(const GridGeometry& grid, const Vec3f& origin_m, const Vec3f& end_m) {
  std::vector<Key> keys;
  walk_ray(grid, origin_m, end_m, [&](const Key& key) {
    keys.push_back(key);
    return true;
  });
  return keys;
}

OctomapTwin twin_of(double resolution_m) { return OctomapTwin({.resolution_m = resolution_m}); }

/// A point of the box with some coordinates moved onto a voxel border, or onto those of `other`.
Vec3f awkward_point(Random& random, double resolution_m, const Vec3f& other) {
  Vec3f p_m = random.point_in(Box3(kBox_m.min() - Vec3::Ones(), kBox_m.max() + Vec3::Ones()));
  for (int a = 0; a < 3; ++a) {
    const double kind = random.uniform(0.0, 1.0);
    if (kind < 0.15) {
      p_m[a] = static_cast<float>(std::round(p_m[a] / resolution_m) * resolution_m);
    } else if (kind < 0.3) {
      p_m[a] = other[a];
    }
  }
  return p_m;
}

TEST(RayWalk, NamesTheVoxelsOfComputeRayKeysInOrderAndWithinTheGridUpToWhereTheyLeaveIt) {
  for (const double resolution_m : {0.2, 0.07, 0.05}) {
    const GridGeometry grid(kBox_m, resolution_m);
    const OctomapTwin twin = twin_of(resolution_m);
    Random random(17);
    for (int ray = 0; ray < 40000; ++ray) {
      const Vec3f origin_m = awkward_point(random, resolution_m, Vec3f::Zero());
      Vec3f end_m = awkward_point(random, resolution_m, origin_m);
      if (random.chance(0.05)) end_m = origin_m + 0.01F * (end_m - origin_m);  // most in one voxel
      const std::vector<Key> expected = twin.ray_keys(origin_m, end_m);
      ASSERT_EQ(walked(grid, origin_m, end_m), expected)
          << "resolution " << resolution_m << ", ray " << ray << ", " << origin_m.transpose()
          << " to " << end_m.transpose();
      const RayOrigin origin = make_ray_origin(grid, origin_m);
      if (!grid.contains(origin.key)) continue;
      std::vector<Key> inside;
      walk_ray_inside(grid, origin, end_m, [&](VoxelIndex v) {
        inside.push_back(grid.key_at(v));
        return true;
      });
      const auto leaves =
          std::ranges::find_if_not(expected, [&](const Key& key) { return grid.contains(key); });
      ASSERT_TRUE(std::ranges::equal(inside, std::ranges::subrange(expected.begin(), leaves)))
          << resolution_m << " " << ray;
    }
  }
}

TEST(RayWalk, EndsThatFloat32CannotTellApartTakeNoStep) {
  const GridGeometry grid(kBox_m, 0.2);
  // the squared length underflows to zero; OctoMap divides by it
  EXPECT_LE(walked(grid, Vec3f(-1e-30F, -1e-30F, 0.0F), Vec3f(1e-30F, 1e-30F, 0.0F)).size(), 1U);
}

TEST(GridGeometry, IndexAndKeyAreInverse) {
  const GridGeometry grid(Box3(Vec3(-1, 0.4, -2), Vec3(0.6, 1, -1.2)), 0.2);
  EXPECT_EQ(grid.voxel_count(), 8U * 3U * 4U);
  for (VoxelIndex v = 0; v < grid.voxel_count(); ++v) {
    ASSERT_TRUE(grid.contains(grid.key_at(v)));
    ASSERT_EQ(grid.index_of(grid.key_at(v)), v);
    ASSERT_EQ(grid.key_of(grid.center_m(grid.key_at(v))), grid.key_at(v));
  }
}

TEST(GridGeometry, ContainsNothingBeyondItsBoundsNorNan) {
  const GridGeometry grid(kBox_m, 0.2);
  EXPECT_EQ(grid.size(), (Key{40, 30, 20}));
  const Vec3 inside_m(0.1, 0.1, 0.1);
  for (int a = 0; a < 3; ++a) {
    for (const double bad : {-4.01, 4.01, 1e300, -1e300, std::nan(""), HUGE_VAL, -HUGE_VAL}) {
      Vec3 p_m = inside_m;
      p_m[a] = bad;
      EXPECT_FALSE(grid.contains(grid.key_of(p_m))) << "axis " << a << ", " << bad;
    }
  }
}

TEST(GridGeometry, RefusesWhatItCannotHold) {
  EXPECT_THROW(GridGeometry(kBox_m, 0.0), BadInput);
  EXPECT_THROW(GridGeometry(kBox_m, std::nan("")), BadInput);
  EXPECT_THROW(GridGeometry(Box3(Vec3(0, 0, 0), Vec3(1, 0, 1)), 0.1), BadInput);
  EXPECT_THROW(GridGeometry(Box3(Vec3(0, 0, 0), Vec3(4000, 1, 1)), 0.1), BadInput);
  EXPECT_THROW(GridGeometry(Box3(Vec3(0, 0, 0), Vec3(2000, 2000, 200)), 0.1), BadInput);
}

constexpr double kFloor_m = 0.3;

CameraModel small_camera() { return make_camera_model({.width_px = 4, .height_px = 2}); }

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

// The rule itself, that the fast rays are compared with below.
TEST(RaysOf, ReturnsLieAtTheirDepthAndNoneClearsToThePlaneAtMaximumRange) {
  const CameraModel camera = small_camera();
  struct Case {
    float depth_m;
    bool hit;
    double end_m;  // along the optical axis; 0: no ray
  };
  for (const auto& [depth_m, hit, end_m] : std::vector<Case>{{3.0F, true, 3.0},
                                                             {0.3F, true, 0.3},
                                                             {8.0F, true, 8.0},
                                                             {8.1F, false, 8.0},
                                                             {kNoReturn, false, 8.0},
                                                             {kInvalidRange, false, 0.0},
                                                             {0.29F, false, 0.0},
                                                             {0.0F, false, 0.0},
                                                             {-1.0F, false, 0.0}}) {
    const DepthFrame frame = frame_of(camera, depth_m);
    const std::vector<ScanRay> rays = rays_of(frame, camera, kFloor_m);
    ASSERT_EQ(rays.size(), end_m > 0.0 ? 8U : 0U) << depth_m;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      EXPECT_EQ(rays[i].hit, hit) << depth_m;
      const Vec3f ray = camera.ray_camera(static_cast<int>(i % 4), static_cast<int>(i / 4));
      const Vec3 expected_m = end_m * ray.cast<double>();  // a plane, not a sphere
      EXPECT_LT((in_camera(frame, rays[i]) - expected_m).norm(), 2.0 * kFloatSlack_m);
    }
  }
  DepthFrame frame = frame_of(camera, 4.0F);
  for (const ScanRay& ray : rays_of(frame, camera, 5.0)) {  // the horizon is the floor: it clears
    EXPECT_EQ(ray.hit, ray.end_world_m.z() > 5.0F);
  }
  frame.depth_m.pop_back();
  FrameRays rays;
  EXPECT_THROW(rays_of(frame, camera, kFloor_m), BrokenInvariant);
  EXPECT_THROW(compute_frame_rays(frame, camera, kFloor_m, rays), BrokenInvariant);
}

TEST(RaysOf, LidarRangesAreSpherical) {
  const LidarConfig lidar{.beams = 5};
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
      frame.T_world_camera = random_pose(random, Box3(Vec3(-20, -20, 0), Vec3(20, 20, 20)));
      frame.depth_m = noise_depths(random, camera);
      frame.depth_m.front() = static_cast<float>(range_max_m);
      frame.depth_m.back() = 0.3F;
      const double floor_z_m = frame.T_world_camera.translation().z() - 0.5;
      for (const NoReturn no_return : {NoReturn::free, NoReturn::unknown}) {
        const std::vector<ScanRay> expected = rays_of(frame, camera, floor_z_m, no_return);
        compute_frame_rays(frame, camera, floor_z_m, rays, no_return);
        ASSERT_EQ(rays.end_m[0].size(), frame.depth_m.size());
        const std::vector<ScanRay> each = compact(rays);
        ASSERT_EQ(each.size(), expected.size());
        for (std::size_t i = 0; i < each.size(); ++i) {
          expect_same_bits(each[i].end_world_m, expected[i].end_world_m);
          ASSERT_EQ(each[i].hit, expected[i].hit);
        }
      }
      expect_same_bits(rays.origin_world_m,
                       Vec3f(frame.T_world_camera.translation().cast<float>()));
    }
  }
}

GNBV_AT_EVERY_SIMD_LEVEL(FrameRaysAt);

}  // namespace
}  // namespace gnbv
