#include <gtest/gtest.h>

#include "sensors/capture.hpp"
#include "tests/sensors/shapes.hpp"

namespace gnbv {
namespace {

using test::add_wall;
using test::world_of;

CameraModel camera_with(double pitch_rad, double range_min_m, double range_max_m, int width_px = 64,
                        int height_px = 48) {
  return make_camera_model({.width_px = width_px,
                            .height_px = height_px,
                            .range_min_m = range_min_m,
                            .range_max_m = range_max_m,
                            .pitch_rad = pitch_rad});
}

float at(const CameraModel& camera, const DepthFrame& frame, int u, int v) {
  return frame.depth_m[static_cast<std::size_t>(v * camera.config.width_px + u)];
}

Vec3 direction_world(const CameraModel& camera, const DepthFrame& frame, int u, int v) {
  return frame.T_world_camera.linear() * camera.ray_camera(u, v).cast<double>();
}

bool all_of_kind(const DepthFrame& frame, bool (*kind)(float)) {
  return std::all_of(frame.depth_m.begin(), frame.depth_m.end(), kind);
}
bool is_invalid(float depth_m) { return std::isnan(depth_m); }
bool is_no_return(float depth_m) { return depth_m == kNoReturn; }
bool is_depth(float depth_m) { return std::isfinite(depth_m); }

TEST(DepthCapture, FieldOfViewEndsAtTheImageBorder) {
  const CameraModel camera = camera_with(0.0, 0.3, 8.0, 640, 480);
  const double half_y_m = 5.0 * std::tan(deg_to_rad(30.0));
  const double half_z_m = 5.0 * std::tan(deg_to_rad(22.5));
  // a wall that ends half a pixel beyond the outermost centres, then half a pixel before them;
  // centres are 1 / 640 and 1 / 480 of the half width inside the border
  for (const double pixels_from_border : {0.5, 1.5}) {
    const double y_m = half_y_m * (1.0 - pixels_from_border / 320.0);
    const double z_m = half_z_m * (1.0 - pixels_from_border / 240.0);
    TriangleMesh wall;
    // border pixel centres lie half a pixel inside; move the rim half a pixel to either side
    add_wall(wall, 5.0, -y_m, y_m, -z_m, z_m);
    const RayScene scene(world_of(wall, false));
    const DepthFrame frame = capture_depth(scene, camera, 0, Isometry::Identity(), {}, 1);
    const int lost = pixels_from_border < 1.0 ? 0 : 1;
    for (int v = 0; v < 480; ++v) {
      for (int u = 0; u < 640; ++u) {
        const bool inside = u >= lost && u < 640 - lost && v >= lost && v < 480 - lost;
        ASSERT_EQ(is_depth(at(camera, frame, u, v)), inside) << u << ", " << v;
      }
    }
  }
}

TEST(DepthCapture, LeftOfTheImageIsLeftOfTheBodyAndPositivePitchLooksDown) {
  TriangleMesh wall;
  add_wall(wall, 5.0, 0.0, 50.0, -50.0, 50.0);  // y > 0 only
  const CameraModel level = camera_with(0.0, 0.3, 8.0);
  const DepthFrame half =
      capture_depth(RayScene(world_of(wall, false)), level, 3, Isometry::Identity(), {}, 1);
  EXPECT_EQ(half.camera, 3);
  for (int v = 0; v < 48; ++v) {
    for (int u = 0; u < 64; ++u) EXPECT_EQ(is_depth(at(level, half, u, v)), u < 32);
  }
  // an odd number of rows, so that the middle row is the optical axis
  const CameraModel camera = camera_with(deg_to_rad(20.0), 0.3, 100.0, 65, 49);
  const DepthFrame frame = capture_depth(RayScene(world_of({}, true)), camera, 0,
                                         T_world_body({{7, 8, 5.0}, -1.0}), {}, 1);
  EXPECT_NEAR(at(camera, frame, 32, 24), 5.0 / std::sin(deg_to_rad(20.0)), 1e-4);  // float, 15 m
  EXPECT_LT(at(camera, frame, 32, 48), at(camera, frame, 32, 24));
  EXPECT_TRUE(is_no_return(at(camera, frame, 32, 0)));  // 2.5 degrees above the horizon
}

TEST(DepthCapture, GroundIsThePlaneZeroSeenFromBothSides) {
  const RayScene scene(world_of({}, true));
  const CameraModel down = camera_with(deg_to_rad(90.0), 0.3, 100.0);
  const CameraModel up = camera_with(deg_to_rad(-90.0), 0.3, 100.0);
  const DepthFrame above =
      capture_depth(scene, down, 0, T_world_body({{-300, 20, 6.5}, 0.7}), {}, 1);
  const DepthFrame below = capture_depth(scene, up, 0, T_world_body({{30, 400, -2.0}, 0.7}), {}, 1);
  for (const float depth_m : above.depth_m) ASSERT_NEAR(depth_m, 6.5, 6.5e-6);  // 1e-6 relative
  for (const float depth_m : below.depth_m) ASSERT_NEAR(depth_m, 2.0, 2.0e-6);
  const RayScene empty(world_of({}, false));
  EXPECT_TRUE(all_of_kind(capture_depth(empty, down, 0, T_world_body({{0, 0, 6.5}, 0}), {}, 1),
                          is_no_return));
}

TEST(DepthCapture, EqualsBruteForceAtEveryPixel) {
  const TriangleMesh soup = test::random_soup(60, 3.0, {0, 0, 0}, 11);
  const RayScene scene(world_of(soup, false));
  const CameraModel camera = camera_with(deg_to_rad(-10.0), 0.3, 8.0, 61, 50);  // no multiple of 4
  int hits = 0, near = 0, undecided = 0;
  for (int view = 0; view < 12; ++view) {
    const double yaw_rad = 0.8 * view;
    const double away_m = view < 8 ? 5.0 : 0.5;  // and amid them
    const Vec3 p_world_m(-away_m * std::cos(yaw_rad), -away_m * std::sin(yaw_rad), -1.0);
    const DepthFrame frame =
        capture_depth(scene, camera, 0, T_world_body({p_world_m, yaw_rad}), {}, 2);
    for (int v = 0; v < 50; ++v) {
      for (int u = 0; u < 61; ++u) {
        const auto [expected_m, face, is_near_edge] = test::brute_first_hit(
            soup, frame.T_world_camera.translation(), direction_world(camera, frame, u, v));
        if (is_near_edge || std::abs(expected_m - 8.0) < 1e-4 ||
            std::abs(expected_m - 0.3) < 1e-4) {
          ++undecided;
          continue;
        }
        const float depth_m = at(camera, frame, u, v);
        if (expected_m > 8.0) {  // a plane, not a sphere
          ASSERT_TRUE(is_no_return(depth_m)) << u << ", " << v << " of view " << view;
        } else if (expected_m < 0.3) {  // hides what is behind it
          ASSERT_TRUE(is_invalid(depth_m)) << u << ", " << v << " of view " << view;
          ++near;
        } else {
          // float rays; triangles met under a few degrees magnify their rounding
          ASSERT_NEAR(depth_m, expected_m, 5e-5) << u << ", " << v << " of view " << view;
          ++hits;
        }
      }
    }
  }
  EXPECT_GT(hits, 3000);
  EXPECT_GT(near, 100);
  EXPECT_LT(undecided, 600);
}

DepthFrame wall_seen(double wall_m, double return_max_m, double range_max_m) {
  TriangleMesh wall;
  add_wall(wall, wall_m, -100, 100, -100, 100);
  CameraModel camera = camera_with(0.0, 0.3, range_max_m);
  camera.config.return_max_m = return_max_m;
  return capture_depth(RayScene(world_of(wall, false)), camera, 0, Isometry::Identity(), {}, 1);
}

TEST(DepthCapture, DeeperThanReturnMaxNothingReturns) {
  for (const auto& [wall_m, return_max_m, range_max_m, returns] :
       {std::tuple(4.0, 5.0, 8.0, true), std::tuple(6.0, 5.0, 8.0, false),
        std::tuple(4.999, 5.0, 8.0, true),  // a plane: in the corners 5.87 m away
        std::tuple(5.001, 5.0, 8.0, false), std::tuple(6.0, 0.0, 8.0, true),
        std::tuple(7.9, 9.0, 8.0, true), std::tuple(8.1, 9.0, 8.0, false)}) {
    EXPECT_TRUE(all_of_kind(wall_seen(wall_m, return_max_m, range_max_m),
                            returns ? is_depth : is_no_return))
        << wall_m << " " << return_max_m << " " << range_max_m;
  }
}

TEST(DepthCapture, WhatLiesExactlyAtReturnMaxReturns) {
  const float read_m = wall_seen(5.0, 0.0, 8.0).depth_m[0];
  ASSERT_NEAR(read_m, 5.0, 1e-5);
  EXPECT_EQ(wall_seen(5.0, read_m, 8.0).depth_m[0], read_m);
  EXPECT_EQ(wall_seen(5.0, std::nextafter(read_m, 0.0F), 8.0).depth_m[0], kNoReturn);
}

}  // namespace
}  // namespace gnbv
