// Lenses: the inverse is the inverse, and a lens that does nothing is the pinhole.
#include "sensors/lens.hpp"

#include <gtest/gtest.h>

#include "planner/view/visibility.hpp"
#include "sensors/capture.hpp"
#include "sim/core/rng.hpp"
#include "tests/sensors/shapes.hpp"

namespace gnbv {
namespace {

using test::add_wall;
using test::world_of;
using Vec2 = Eigen::Vector2d;

double random(std::uint64_t item, double low, double high) {
  return low + (high - low) * uniform01({7, Stream::start_pose, item, 0});
}

/// Of real lenses: action cameras, an OV9281, a T265, a D435, and the last two of every sign.
std::vector<DistortionConfig> lenses() {
  using enum Distortion;
  std::vector<DistortionConfig> all = {
      {brown_conrady, -0.28, 0.07, 0.0, 0, 0, 0, 2e-4, -1e-5},
      {brown_conrady, 0.14, -0.49, 0.45, 0, 0, 0, -6e-4, 1e-3},
      {brown_conrady, 8.7, 5.1, 0.24, 9.0, 8.0, 1.4, 1e-4, -5e-5},
      {kannala_brandt, -0.0065, 0.043, -0.041, 0.0077},
      {kannala_brandt},
      {kannala_brandt, -0.4, 0.1, 0.0, 0.0},
  };
  for (std::uint64_t i = 0; i < 30; ++i) {
    const auto k = [&](std::uint64_t n, double size) { return random(10 * i + n, -size, size); };
    all.push_back({brown_conrady, k(0, 0.4), k(1, 0.2), k(2, 0.1), k(3, 0.1), k(4, 0.05),
                   k(5, 0.02), k(6, 2e-3), k(7, 2e-3)});
    all.push_back({kannala_brandt, k(0, 0.2), k(1, 0.1), k(2, 0.05), k(3, 0.02)});
  }
  return all;
}

Lens lens_of(const DistortionConfig& distortion, double focal_px = 320.0) {
  return Lens(640, 480, {focal_px, 1.02 * focal_px, 331.5, 236.25, 1.5}, distortion);
}

TEST(Lens, UndistortingUndoesDistortingAsFarAsTheModelGoes) {
  for (const DistortionConfig& distortion : lenses()) {
    const Lens lens = lens_of(distortion);
    ASSERT_GT(lens.radius_max(), 0.2) << distortion.k1;
    for (std::uint64_t i = 0; i < 2000; ++i) {
      const double off_rad = random(2 * i, 0.0, std::atan(lens.radius_max()));
      const double bearing_rad = random(2 * i + 1, -kPi, kPi);
      const Vec2 xy = std::tan(off_rad) * Vec2(std::cos(bearing_rad), std::sin(bearing_rad));
      const auto back = lens.undistort(lens.distort(xy));
      if (!back) {  // a hair beyond the rim
        EXPECT_GT(xy.norm(), 0.999 * lens.radius_max());
        continue;
      }
      // angles: towards 85 degrees a tangent is 130 times its angle's error
      const double off =
          Vec3(back->homogeneous().normalized() - xy.homogeneous().normalized()).norm();
      EXPECT_LT(off, 1e-9) << xy.transpose() << " k1 " << distortion.k1;
    }
  }
}

TEST(Lens, EveryPixelThatIsSeenShowsTheDirectionThatProjectsToIt) {
  for (const DistortionConfig& distortion : lenses()) {
    const Lens lens = lens_of(distortion);
    for (double v = 0.5; v < 480.0; v += 13.0) {
      for (double u = 0.5; u < 640.0; u += 13.0) {
        const auto xy = lens.direction_at(u, v);
        if (!xy) continue;
        EXPECT_LT(lens.sight().exteriorDistance(*xy), 1e-2 * xy->norm()) << distortion.k1;
        EXPECT_LT((lens.pixel_of(2.5 * xy->homogeneous()) - Vec2(u, v)).norm(), 1e-8);
      }
    }
  }
}

TEST(Lens, AnEquidistantFisheyeShowsAnglesAsDistancesFromItsCentre) {
  const Lens lens(800, 800, {250.0, 250.0, 400.0, 400.0, 0.0}, {Distortion::kannala_brandt});
  for (const double off_deg : {0.0, 10.0, 45.0, 80.0, 84.9}) {
    const double off_rad = deg_to_rad(off_deg);
    const Vec2 px = lens.pixel_of(Vec3(0.0, std::sin(off_rad), std::cos(off_rad)));
    EXPECT_NEAR(px.x(), 400.0, 1e-9);
    EXPECT_NEAR(px.y(), 400.0 + 250.0 * off_rad, 1e-9);
  }
  EXPECT_FALSE(lens.sees(Vec3(0.0, std::sin(1.5), std::cos(1.5))));  // 86 degrees
  EXPECT_FALSE(lens.direction_at(400.0, 400.0 + 250.0 * 1.5));
  // a cap of 85 degrees: 2 pi (1 - cos) / 3
  EXPECT_NEAR(lens.unit_m3(), 2.0 * kPi * (1.0 - std::cos(deg_to_rad(85.0))) / 3.0, 2e-3);
}

TEST(Lens, AModelThatFoldsEndsBeforeItDoes) {
  // r (1 - 0.5 r^2) turns back at r = sqrt(2 / 3)
  const Lens lens = lens_of({Distortion::brown_conrady, -0.5});
  EXPECT_LT(lens.radius_max(), std::sqrt(2.0 / 3.0));
  EXPECT_GT(lens.radius_max(), 0.9 * std::sqrt(2.0 / 3.0));
  EXPECT_FALSE(lens.undistort({0.6, 0.0}));  // the most that the model reaches is 0.544
  EXPECT_TRUE(std::isnan(lens.pixel_of({0.9, 0.0, 1.0}).x()));
  EXPECT_TRUE(std::isnan(lens.pixel_of({0.1, 0.0, -1.0}).x()));
}

CameraModel camera_of(const DistortionConfig& distortion, double fx_px = 0.0) {
  return make_camera_model(
      {.width_px = 90, .height_px = 70, .fx_px = fx_px, .distortion = distortion});
}

TEST(LensCamera, ALensThatDoesNothingIsThePinhole) {
  const CameraModel plain = camera_of({});
  const CameraModel lensed = camera_of({Distortion::brown_conrady});
  ASSERT_TRUE(lensed.lens);
  EXPECT_LT((plain.sight.max() - lensed.sight.max()).norm(), 1e-12);
  EXPECT_LT((plain.sight.min() - lensed.sight.min()).norm(), 1e-12);
  EXPECT_NEAR(frustum_m3(plain.config), frustum_m3(lensed.config), 0.02 * frustum_m3(plain.config));
  for (const double fx_px : {100.0, 700.0, 5000.0}) {  // ever narrower: a pyramid on its tip
    const CameraConfig narrow = camera_of({Distortion::brown_conrady}, fx_px).config;
    const double pyramid_m3 = 90.0 * 70.0 / (3.0 * fx_px * fx_px) * std::pow(narrow.range_max_m, 3);
    EXPECT_NEAR(frustum_m3(narrow) / pyramid_m3, 1.0, 0.02) << fx_px;
  }
  TriangleMesh wall;
  add_wall(wall, 5.0, -3, 3, -3, 3);
  const RayScene scene(world_of(wall, true));
  const Isometry T = T_world_body({{0.5, 0.2, 2.0}, 0.1});
  for (const DepthNoise noise : {DepthNoise::none, DepthNoise::nguyen, DepthNoise::stereo}) {
    CameraModel a = plain, b = lensed;
    a.config.noise.model = b.config.noise.model = noise;
    const DepthFrame by_plain = capture_depth(scene, a, 0, T, {3, 4}, 1);
    const DepthFrame by_lens = capture_depth(scene, b, 0, T, {3, 4}, 1);
    int unlike = 0;
    for (std::size_t i = 0; i < by_plain.depth_m.size(); ++i) {
      const float x = by_plain.depth_m[i], y = by_lens.depth_m[i];
      unlike += !(x == y || (std::isnan(x) && std::isnan(y)) || std::abs(x - y) < 1e-4F);
    }
    EXPECT_LE(unlike, 3) << static_cast<int>(noise);  // rays past an edge of the wall
  }
  const ViewRays rays = make_view_rays(std::vector{plain}, 0.2);
  const ViewRays by_lens = make_view_rays(std::vector{lensed}, 0.2);
  EXPECT_EQ(rays.count(), by_lens.count());
  EXPECT_EQ(rays.end_body_m, by_lens.end_body_m);
}

TEST(LensCamera, AFramesRaysEndWhereTheirPixelsProjectFrom) {
  TriangleMesh wall;
  add_wall(wall, 4.0, -100, 100, -100, 100);
  const RayScene scene(world_of(wall, false));
  for (const DistortionConfig& distortion : lenses()) {
    const CameraModel camera = camera_of(distortion, 40.0);
    const DepthFrame frame = capture_depth(scene, camera, 0, T_world_body({{1, 2, 3}, 0.3}), {}, 1);
    FrameRays rays;
    compute_frame_rays(frame, camera, -1e9, rays);
    for (std::size_t i = 0; i < frame.depth_m.size(); i += 7) {
      const bool is_seen = !std::isnan(camera.lens->directions()[i].x());
      EXPECT_EQ(rays.kind[i] == PixelRay::none, !is_seen || std::isnan(frame.depth_m[i]));
      if (rays.kind[i] == PixelRay::none) continue;
      const Vec3 end_m = frame.T_world_camera.inverse() * rays.end_world_m(i).cast<double>();
      const Vec2 px = camera.lens->pixel_of(end_m);
      EXPECT_NEAR(px.x(), static_cast<double>(i % 90) + 0.5, 2e-3);
      EXPECT_NEAR(px.y(), static_cast<double>(i / 90) + 0.5, 2e-3);
      if (rays.kind[i] == PixelRay::hits) {
        EXPECT_NEAR(rays.end_world_m(i).x(), 4.0F, 1e-4F);
        EXPECT_NEAR(end_m.z(), frame.depth_m[i], 1e-4);
        EXPECT_LE(camera.range_of(end_m), camera.config.range_max_m + 1e-4);
      } else {
        EXPECT_NEAR(camera.range_of(end_m), camera.config.range_max_m, 1e-4);
      }
    }
  }
}

TEST(LensCamera, AFisheyesViewRaysAreOneAVoxelOfItsSphereAndAllInItsImage) {
  const CameraModel camera = camera_of({Distortion::kannala_brandt}, 30.0);
  constexpr double kResolution_m = 0.2;
  const ViewRays rays = make_view_rays(std::vector{camera}, kResolution_m);
  const double range_m = camera.config.range_max_m;
  const double expected = 3.0 * frustum_m3(camera.config) / (range_m * std::pow(kResolution_m, 2));
  EXPECT_NEAR(static_cast<double>(rays.count()), expected, 0.02 * expected);
  for (std::size_t i = 0; i < rays.count(); ++i) {
    const Vec3 end_m(rays.end_body_m[0][i], rays.end_body_m[1][i], rays.end_body_m[2][i]);
    EXPECT_NEAR(end_m.norm(), range_m, 1e-9);
    EXPECT_TRUE(camera.lens->sees(camera.T_body_camera.inverse() * end_m));
  }
}

}  // namespace
}  // namespace gnbv
