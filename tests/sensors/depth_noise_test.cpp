// Each law of depth noise, measured on frames of a wall: at n pixels an error of 5 % in a
// coefficient, which is 10 % of the variance, lies 10 % / sqrt(2 / n) standard deviations off, that
// is 12 at n = 30,000, where four are allowed.
#include "sensors/depth_noise.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "sensors/capture.hpp"
#include "tests/sensors/shapes.hpp"
#include "tests/sensors/statistics.hpp"

namespace gnbv {
namespace {

using test::add_sheet;
using test::is_standard;
using test::world_of;

constexpr DepthNoise kModels[] = {DepthNoise::released, DepthNoise::khoshelham, DepthNoise::nguyen,
                                  DepthNoise::stereo};

CameraConfig narrow_camera(DepthNoise model) {
  // so narrow that depth and incidence are nearly the same everywhere
  return {.width_px = 240,
          .height_px = 160,
          .fov_x_rad = deg_to_rad(3.0),
          .fov_y_rad = deg_to_rad(2.0),
          .range_min_m = 0.1,
          .range_max_m = 20.0,
          .noise = {.model = model}};
}

/// A wall through (z_m, 0, 0) whose normal is `tilt_rad` off the camera's axis, about body z.
TriangleMesh slanted_wall(double z_m, double tilt_rad) {
  TriangleMesh wall;
  const Vec3 along(-std::sin(tilt_rad), std::cos(tilt_rad), 0.0);
  const Vec3 up(0.0, 0.0, 20.0);
  add_sheet(wall, Vec3(z_m, 0, 0) - 40.0 * along - up, 80.0 * along, 2.0 * up);
  return wall;
}

/// Errors of a frame of the wall, each over the deviation that `sigma` gives it.
template <typename Sigma>
std::vector<double> errors(const CameraConfig& config, double z_m, double tilt_rad,
                           const NoiseKey& key, const Sigma& sigma) {
  const RayScene scene(world_of(slanted_wall(z_m, tilt_rad), false));
  const CameraModel camera = make_camera_model(config);
  const DepthFrame frame = capture_depth(scene, camera, 0, Isometry::Identity(), key, 2);
  std::vector<double> sample;
  for (int v = 0; v < config.height_px; ++v) {
    for (int u = 0; u < config.width_px; ++u) {
      const Vec3 ray = R_body_optical() * camera.ray_camera(u, v).cast<double>();
      const Vec3 normal(std::cos(tilt_rad), std::sin(tilt_rad), 0.0);
      const double true_m = z_m * normal.x() / normal.dot(ray);
      const double theta_rad = std::acos(normal.dot(ray) / ray.norm());
      const auto pixel = static_cast<std::size_t>(v * config.width_px + u);
      sample.push_back((frame.depth_m[pixel] - true_m) / sigma(true_m, theta_rad));
    }
  }
  return sample;
}

TEST(DepthNoise, GrowsWithTheSquareOfTheDepthAsEachSourceHasIt) {
  CameraConfig stereo = narrow_camera(DepthNoise::stereo);
  stereo.noise.baseline_m = 0.07;
  stereo.noise.disparity_noise_px = 1.3;  // of a long lens: 4583 pixels
  const double focal_px = 120.0 / std::tan(deg_to_rad(1.5));
  for (const auto& [config, per_m, farthest_m] :
       {std::tuple(narrow_camera(DepthNoise::released), 0.0025, 8.0),
        std::tuple(narrow_camera(DepthNoise::khoshelham), 1.425e-3, 5.0),
        std::tuple(stereo, 1.3 / (focal_px * 0.07), 8.0)}) {
    const double share = per_m;
    for (const double z_m : {0.7, 3.0, farthest_m}) {
      EXPECT_TRUE(is_standard(errors(config, z_m, 0.5, {3, 5}, [&](double z, double) {
        return share * z * z;
      }))) << z_m;
    }
  }
  // Khoshelham's own figure: about 4 cm at the maximum range of 5 m
  const CameraModel kinect = make_camera_model(narrow_camera(DepthNoise::khoshelham));
  EXPECT_NEAR(depth_sigma_m(kinect, 5.0, 0.0), 0.0356, 1e-4);
  // the ZED Mini at 1280 x 720, as its maker's figures give it
  const CameraConfig zed{
      .width_px = 1280, .fov_x_rad = deg_to_rad(90.0), .noise = {DepthNoise::stereo, 0.063, 0.1}};
  EXPECT_NEAR(depth_sigma_m(make_camera_model(zed), 1.0, 0.0), 2.48e-3, 5e-6);
}

/// Nguyen's axial law as published.
double nguyen_axial_m(double z_m, double theta_rad) {
  const double facing_m = 0.0012 + 0.0019 * std::pow(z_m - 0.4, 2);
  if (theta_rad <= deg_to_rad(60.0)) return facing_m;
  return facing_m + 0.0001 / std::sqrt(z_m) * std::pow(theta_rad / (0.5 * kPi - theta_rad), 2);
}

TEST(DepthNoise, NguyenDependsOnDepthAndIncidence) {
  for (const double z_m : {0.6, 1.5, 4.0}) {
    for (const double tilt_deg : {0.0, 40.0, 58.0, 65.0, 75.0}) {
      // a lateral displacement of s pixels on a slanted wall is a depth of s z tan(theta) / f, too
      const CameraConfig config = narrow_camera(DepthNoise::nguyen);
      const double focal_px = make_camera_model(config).fx_px;
      const auto sigma_m = [&](double z, double theta_rad) {
        const double lateral_px = 0.8 + 0.035 * theta_rad / (0.5 * kPi - theta_rad);
        const double slanted_m = lateral_px * z * std::tan(theta_rad) / focal_px;
        return std::hypot(nguyen_axial_m(z, theta_rad), slanted_m);
      };
      EXPECT_TRUE(is_standard(errors(config, z_m, deg_to_rad(tilt_deg), {3, 8}, sigma_m)))
          << z_m << " m, " << tilt_deg << " deg";
    }
  }
}

TEST(DepthNoise, NguyenSeesNothingBeyondEightyDegreesAndThatIsInvalidNotFree) {
  const CameraModel camera = make_camera_model(narrow_camera(DepthNoise::nguyen));
  for (const auto& [tilt_deg, is_seen] : {std::pair(77.0, true), std::pair(83.0, false)}) {
    const RayScene scene(world_of(slanted_wall(3.0, deg_to_rad(tilt_deg)), false));
    const DepthFrame frame = capture_depth(scene, camera, 0, Isometry::Identity(), {}, 1);
    for (const float depth_m : frame.depth_m) ASSERT_EQ(std::isfinite(depth_m), is_seen);
    for (const float depth_m : frame.depth_m) ASSERT_NE(depth_m, kNoReturn);
  }
  const DepthNoiseConfig nguyen = {DepthNoise::nguyen};
  EXPECT_EQ(lateral_sigma_px(nguyen, 0.5 * kPi), lateral_sigma_px(nguyen, deg_to_rad(80.0)));
  EXPECT_EQ(lateral_sigma_px({DepthNoise::stereo}, 1.0), 0.0);
}

TEST(DepthNoise, NguyenDisplacesAnEdgeByItsLateralDeviation) {
  // an edge through the middle of an image of 8 pixels, upright or level: the share of pixels, d
  // pixels outside of it, that still see the wall is the normal law's tail beyond d / 0.8
  constexpr int kAcross = 8;
  constexpr int kAlong = 2000;
  constexpr int kFrames = 25;
  for (const bool is_upright : {true, false}) {
    CameraConfig config = narrow_camera(DepthNoise::nguyen);
    config.width_px = is_upright ? kAcross : kAlong;
    config.height_px = is_upright ? kAlong : kAcross;
    config.fov_x_rad = 1e-4 * config.width_px;
    config.fov_y_rad = 1e-4 * config.height_px;
    const CameraModel camera = make_camera_model(config);
    // y > 0 is the left of the image, z > 0 its top
    TriangleMesh wall;
    test::add_wall(wall, 4.0, is_upright ? 0 : -9, 9, is_upright ? -9 : 0, 9);
    const RayScene scene(world_of(wall, false));
    std::array<double, kAcross> seen{};
    for (std::uint64_t tick = 0; tick < kFrames; ++tick) {
      const DepthFrame frame = capture_depth(scene, camera, 0, Isometry::Identity(), {1, tick}, 2);
      for (std::size_t i = 0; i < frame.depth_m.size(); ++i) {
        const std::size_t across = is_upright ? i % kAcross : i / kAlong;
        seen[across] += std::isfinite(frame.depth_m[i]) ? 1.0 : 0.0;
      }
    }
    for (std::size_t across = 2; across < 6; ++across) {
      const double outside_px = static_cast<double>(across) + 0.5 - 0.5 * kAcross;
      const double expected = 0.5 * std::erfc(outside_px / 0.8 / std::sqrt(2.0));
      constexpr double kTrials = kFrames * kAlong;
      // four standard deviations of the binomial law are 0.008 at half a pixel; 5 % of 0.8 px would
      // shift the share by 0.010
      const double allowed = 4.0 * std::sqrt(expected * (1.0 - expected) / kTrials);
      EXPECT_NEAR(seen[across] / kTrials, expected, allowed) << outside_px;
    }
  }
}

TEST(DepthNoise, ReturnMaxEndsReadingsAndChangesNone) {
  // of a wall there, half of the pixels read more
  const RayScene scene(world_of(slanted_wall(5.0, 0.0), false));
  for (const DepthNoise model : kModels) {
    CameraConfig config = narrow_camera(model);
    const auto depths = [&] {
      const CameraModel camera = make_camera_model(config);
      return capture_depth(scene, camera, 0, Isometry::Identity(), {3, 8}, 2).depth_m;
    };
    const std::vector<float> far_m = depths();
    config.return_max_m = 5.0;
    const std::vector<float> near_m = depths();
    std::size_t ended = 0;
    for (std::size_t i = 0; i < far_m.size(); ++i) {
      ended += far_m[i] > 5.0F ? 1 : 0;
      ASSERT_EQ(near_m[i], far_m[i] > 5.0F ? kNoReturn : far_m[i]) << i;
    }
    // four standard deviations of the binomial law
    const auto all = static_cast<double>(far_m.size());
    EXPECT_NEAR(static_cast<double>(ended), 0.5 * all, 2.0 * std::sqrt(all));
  }
}

TEST(DepthNoise, IsKeyedBySeedTickAndCameraNotByThreads) {
  CameraConfig config;
  config.width_px = 161;  // no multiple of 4
  config.height_px = 119;
  const RayScene scene(world_of(test::random_soup(300, 5.0, {6, 0, 0}, 5), true));
  for (const DepthNoise model : kModels) {
    config.noise.model = model;
    const auto depths = [&](int camera, const NoiseKey& key, int threads) {
      return capture_depth(scene, make_camera_model(config), camera,
                           T_world_body({{-3, 1, 2}, 0.1}), key, threads)
          .depth_m;
    };
    const std::vector<float> first = depths(0, {1, 2}, 1);
    EXPECT_EQ(std::memcmp(first.data(), depths(0, {1, 2}, 5).data(), 4 * first.size()), 0);
    // floats of a few metres carry 23 bits: two noises agree on next to no pixel
    EXPECT_LT(test::agreement(first, depths(0, {2, 2}, 1)), 1e-3);
    EXPECT_LT(test::agreement(first, depths(0, {1, 3}, 1)), 1e-3);
    EXPECT_LT(test::agreement(first, depths(1, {1, 2}, 1)), 1e-3);
  }
}

TEST(DepthNoise, PixelsOfAFrameAreIndependent) {
  // neighbours correlate by no more than chance: four of 1 / sqrt(n)
  CameraConfig config = narrow_camera(DepthNoise::released);
  const RayScene scene(world_of(slanted_wall(3.0, 0.0), false));
  const DepthFrame frame =
      capture_depth(scene, make_camera_model(config), 0, Isometry::Identity(), {1, 1}, 1);
  for (const std::size_t lag : {1U, 2U, 4U, 240U, 961U}) {
    double sum = 0.0;
    const std::size_t n = frame.depth_m.size() - lag;
    for (std::size_t i = 0; i < n; ++i) {
      sum += (frame.depth_m[i] - 3.0) * (frame.depth_m[i + lag] - 3.0) / std::pow(0.0225, 2);
    }
    EXPECT_LT(std::abs(sum / static_cast<double>(n)), 4.0 / std::sqrt(n)) << lag;
  }
}

/// Depths of a wall across the axis, or of nothing at 0.
std::vector<float> depths_of_wall(const CameraConfig& config, double z_m) {
  const TriangleMesh wall = z_m > 0.0 ? slanted_wall(z_m, 0.0) : TriangleMesh{};
  return capture_depth(RayScene(world_of(wall, false)), make_camera_model(config), 0,
                       Isometry::Identity(), {}, 1)
      .depth_m;
}

TEST(DepthNoise, NearTheMinimumReadingsAreInvalidNeverFreeAndAtTheMaximumTheReadingDecides) {
  CameraConfig config = narrow_camera(DepthNoise::released);
  config.range_min_m = 4.0;
  config.range_max_m = 8.0;
  const auto share_of = [&](double z_m, const auto& is_so) {
    const std::vector<float> depths_m = depths_of_wall(config, z_m);
    for (const float d : depths_m)
      EXPECT_TRUE(std::isnan(d) || d == kNoReturn || (d >= 4 && d <= 8));
    return static_cast<double>(std::ranges::count_if(depths_m, is_so)) / (240 * 160);
  };
  const auto is_invalid = [](float d) { return std::isnan(d); };
  const auto is_beyond = [](float d) { return d == kNoReturn; };
  // a wall just too near is never read, whatever the noise; one just far enough half the time
  EXPECT_EQ(share_of(3.99, is_invalid), 1.0);
  EXPECT_NEAR(share_of(4.0001, is_invalid), 0.5, 0.011);  // four of 0.5 / sqrt(38400)
  EXPECT_EQ(share_of(4.0001, is_beyond), 0.0);
  // deviations of 0.16 m: from one beyond the maximum 16 % still read within it, and as many from
  // one before it read beyond; that is the normal law's tail, to four binomial deviations
  for (const double z_m : {7.84, 8.0, 8.16}) {
    const double expected = 0.5 * std::erfc((8.0 - z_m) / (0.0025 * z_m * z_m) / std::sqrt(2.0));
    EXPECT_NEAR(share_of(z_m, is_beyond), expected, 0.011) << z_m;
    EXPECT_EQ(share_of(z_m, is_invalid), 0.0) << z_m;
  }
  for (const DepthNoise model : kModels) {
    config.noise.model = model;
    EXPECT_EQ(share_of(0.0, is_beyond), 1.0) << "nothing is there";
  }
}

}  // namespace
}  // namespace gnbv
