#include <gtest/gtest.h>

#include <random>
#include <set>

#include "sensors/capture.hpp"
#include "sim/core/image.hpp"
#include "tests/sensors/shapes.hpp"

namespace gnbv {
namespace {

using test::add_sheet;
using test::add_wall;
using test::world_of;

using Rgb = std::array<std::uint8_t, 3>;

CameraModel colour_camera(double pitch_rad, int width_px = 160, int height_px = 120) {
  return make_camera_model({.width_px = width_px, .height_px = height_px, .pitch_rad = pitch_rad});
}

/// Gives the faces from `first` on the material of this colour.
void paint(TriangleMesh& mesh, std::size_t first, const std::array<float, 3>& rgb) {
  if (mesh.face_material.empty()) mesh.materials.clear();
  Material material;
  material.rgb = rgb;
  mesh.face_material.resize(first, 0);
  mesh.face_material.resize(mesh.faces.size(), static_cast<std::uint16_t>(mesh.materials.size()));
  mesh.materials.push_back(material);
}

int brightness(const Rgb& rgb) { return rgb[0] + rgb[1] + rgb[2]; }

std::size_t pixel_of(const CameraModel& camera, int u, int v) {
  return static_cast<std::size_t>(v * camera.config.width_px + u);
}

TEST(ColourCapture, IsAlignedWithDepthPixelByPixelAndSeesBeyondItsRange) {
  TriangleMesh scene_mesh = test::sphere({5.0, 0.3, 0.2}, 1.0);
  paint(scene_mesh, 0, {0.6F, 0.0F, 0.0F});
  const std::size_t ball_faces = scene_mesh.faces.size();
  add_wall(scene_mesh, 60.0, -200, 200, -200, 200);
  paint(scene_mesh, ball_faces, {0.0F, 0.0F, 0.6F});
  const RayScene scene(world_of(scene_mesh, false));
  const CameraModel camera = colour_camera(0.1, 161, 119);
  const DepthFrame depth = capture_depth(scene, camera, 0, Isometry::Identity(), {}, 1);
  const ColourFrame colour = capture_colour(scene, camera, 1, Isometry::Identity(), 1);
  EXPECT_EQ(colour.camera, 1);
  EXPECT_EQ(colour.T_world_camera.matrix(), depth.T_world_camera.matrix());
  ASSERT_EQ(colour.rgb.size(), depth.depth_m.size());
  int balls = 0;
  for (std::size_t i = 0; i < colour.rgb.size(); ++i) {
    const bool is_ball = std::isfinite(depth.depth_m[i]);
    ASSERT_EQ(colour.rgb[i][0] > 0, is_ball) << i;
    ASSERT_EQ(colour.rgb[i][2] > 0, !is_ball) << i;
    balls += is_ball ? 1 : 0;
  }
  EXPECT_GT(balls, 1000);
}

TEST(ColourCapture, ASurfaceIsBrighterTheMoreItFacesTheSun) {
  // a plate at the same place turned step by step away from the sun: Lambert's cosine
  const CameraModel camera = colour_camera(deg_to_rad(90.0), 8, 8);
  const Vec3 sun = towards_sun_world().cast<double>();
  const Vec3 axis = sun.cross(Vec3::UnitX()).normalized();
  int previous = 1000;
  for (const double turn_deg : {0.0, 20.0, 40.0}) {
    const Vec3 normal = Eigen::AngleAxisd(deg_to_rad(turn_deg), axis) * sun;
    const Vec3 a = normal.cross(axis);
    TriangleMesh plate;
    add_sheet(plate, -2.0 * (a + axis), 4.0 * a, 4.0 * axis);
    paint(plate, 0, {0.5F, 0.5F, 0.5F});
    // seen from the side of the sun, straight down, so that the ambient light varies little
    const ColourFrame frame = capture_colour(RayScene(world_of(plate, false)), camera, 0,
                                             T_world_body({{0, 0, 3}, 0.0}), 1);
    EXPECT_LT(brightness(frame.rgb[36]), previous) << turn_deg;
    previous = brightness(frame.rgb[36]);
  }
}

TEST(ColourCapture, BothSidesOfAFaceAreLitByTheirOwnNormal) {
  // a wall across the sun's azimuth: bright from the sun's side, dark from the other, whichever way
  // its corners run
  const Vec3f sun = towards_sun_world();
  const double azimuth_rad = std::atan2(sun.y(), sun.x());
  const Vec3 along(-std::sin(azimuth_rad), std::cos(azimuth_rad), 0.0);
  for (const double sense : {1.0, -1.0}) {
    TriangleMesh wall;
    add_sheet(wall, -5.0 * sense * along - Vec3(0, 0, 5), 10.0 * sense * along, {0, 0, 10});
    const RayScene scene(world_of(wall, false));
    const CameraModel camera = colour_camera(0.0, 8, 8);
    const Vec3 towards(std::cos(azimuth_rad), std::sin(azimuth_rad), 0.0);
    const auto seen_from = [&](double side) {
      const double yaw_rad = side > 0.0 ? azimuth_rad + kPi : azimuth_rad;
      return capture_colour(scene, camera, 0, T_world_body({3.0 * side * towards, yaw_rad}), 1)
          .rgb[36];
    };
    EXPECT_GT(brightness(seen_from(1.0)), brightness(seen_from(-1.0)) + 100) << sense;
  }
}

/// A plain floor at 1 m and a plate 2 m above it, which is of the part of the world.
World shaded(TriangleMesh World::*part) {
  World world = world_of({}, false);
  add_sheet(world.structure, {-20, -20, 1.0}, {40, 0, 0}, {0, 40, 0});
  add_sheet(world.*part, {-0.7, -0.5, 3.0}, {1.5, 0, 0}, {0, 1.0, 0});
  return world;
}

class Shadow : public testing::TestWithParam<TriangleMesh World::*> {};

TEST_P(Shadow, FallsWhereTheSunIsHidden) {
  const RayScene scene(shaded(GetParam()));
  const CameraModel camera = colour_camera(deg_to_rad(90.0));
  // above the floor and beside the plate, looking down on where the plate's shadow falls
  const Vec3 sun = towards_sun_world().cast<double>();
  const Vec3 shift_m = 2.0 / sun.z() * sun;  // from a shadow to what throws it
  const Vec3 eye_m(-shift_m.x(), -shift_m.y(), 2.9);
  const DepthFrame depth = capture_depth(scene, camera, 0, T_world_body({eye_m, 0.4}), {}, 1);
  const ColourFrame colour = capture_colour(scene, camera, 0, T_world_body({eye_m, 0.4}), 1);
  std::set<int> dark;
  std::set<int> bright;
  for (int v = 0; v < camera.config.height_px; ++v) {
    for (int u = 0; u < camera.config.width_px; ++u) {
      const std::size_t pixel = pixel_of(camera, u, v);
      const Vec3 floor_m = depth.T_world_camera * Vec3(static_cast<double>(depth.depth_m[pixel]) *
                                                       camera.ray_camera(u, v).cast<double>());
      ASSERT_NEAR(floor_m.z(), 1.0, 1e-5);
      const Vec3 through_m = floor_m + shift_m;
      // within 1 mm of the border float rays may decide otherwise
      const double inside_m = std::min(std::min(through_m.x() + 0.7, 0.8 - through_m.x()),
                                       0.5 - std::abs(through_m.y()));
      if (std::abs(inside_m) < 1e-3) continue;
      (inside_m > 0.0 ? dark : bright).insert(brightness(colour.rgb[pixel]));
    }
  }
  ASSERT_EQ(dark.size(), 1U);  // one material, one normal, one light
  ASSERT_EQ(bright.size(), 1U);
  EXPECT_GT(*bright.begin(), *dark.begin() + 100);
}

INSTANTIATE_TEST_SUITE_P(OfEachPartOfTheWorld, Shadow,
                         testing::Values(&World::structure, &World::obstacles, &World::terrain));

TEST(ColourCapture, APictureThatFillsTheFrameIsTheFrame) {
  // as many pixels as the camera has, on a wall that fills its view: each ray meets the centre of
  // its pixel. Oracle: the picture's colours times the light of the same wall in white.
  const CameraModel camera = make_camera_model(
      {.width_px = 32, .height_px = 32, .fov_x_rad = kPi / 2.0, .fov_y_rad = kPi / 2.0});
  std::mt19937 random(46);
  Image image{32, 32, {}};
  for (int i = 0; i < 3 * 32 * 32; ++i) {
    image.rgb.push_back(static_cast<std::uint8_t>(random() % 256));
  }
  TriangleMesh wall;  // 4 m ahead, seen from the side of its front: right is -y, up is z
  add_sheet(wall, {4, 4, -4}, {0, -8, 0}, {0, 0, 8});
  paint(wall, 0, {1.0F, 1.0F, 1.0F});
  const auto seen = [&] {
    return capture_colour(RayScene(world_of(wall, false)), camera, 0, Isometry::Identity(), 1);
  };
  const ColourFrame white = seen();
  wall.materials[0].texture = {"", std::make_shared<const Image>(image), {}};
  const auto corner = [](float u, float v) { return CornerLook{.uv = {u, v}}; };
  wall.face_looks = {{corner(0, 1), corner(1, 1), corner(1, 0)},
                     {corner(0, 1), corner(1, 0), corner(0, 0)}};
  const ColourFrame frame = seen();
  for (int v = 0; v < 32; ++v) {
    for (int u = 0; u < 32; ++u) {
      const std::size_t pixel = pixel_of(camera, u, v);
      for (std::size_t k = 0; k < 3; ++k) {
        const auto linear = [](std::uint8_t byte) {
          return srgb_to_linear(static_cast<float>(byte) / 255.0F);
        };
        const float expected = linear(white.rgb[pixel][k]) * linear(image.at(u, v)[k]);
        // the white frame is rounded to a level, and so is this one, by a table
        EXPECT_NEAR(frame.rgb[pixel][k], 255.0F * linear_to_srgb(expected), 2.0F) << u << ' ' << v;
      }
    }
  }
}

TEST(ColourCapture, GroundHasFeaturesAndSkyIsBlueOverhead) {
  const RayScene scene(world_of({}, true));
  const ColourFrame down =
      capture_colour(scene, colour_camera(deg_to_rad(60.0)), 0, T_world_body({{0, 0, 5}, 0.0}), 1);
  const std::set<Rgb> looks(down.rgb.begin(), down.rgb.end());
  EXPECT_GT(looks.size(), 30U);
  const ColourFrame up =
      capture_colour(scene, colour_camera(deg_to_rad(-60.0)), 0, T_world_body({{0, 0, 5}, 0.0}), 1);
  const CameraModel camera = colour_camera(0.0);
  const Rgb top = up.rgb[pixel_of(camera, 80, 0)];
  const Rgb bottom = up.rgb[pixel_of(camera, 80, 119)];
  EXPECT_GT(top[2], top[0] + 50);
  EXPECT_GT(brightness(bottom), brightness(top));  // paler towards the horizon
}

TEST(Srgb, EqualsTheStandardsCurveWithinALevel) {
  const SrgbTable table;
  for (int i = 0; i <= 1000; ++i) {
    const double linear = i / 1000.0;
    const double expected =
        255.0 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055);
    // half a level of rounding, and half a step of the table, steepest at black: 0.4 levels
    EXPECT_NEAR(table(static_cast<float>(linear)), expected, 0.91) << linear;
  }
  EXPECT_EQ((Rgb{table(-1.0F), table(0.0F), table(2.0F)}), (Rgb{0, 0, 255}));
}

}  // namespace
}  // namespace gnbv
