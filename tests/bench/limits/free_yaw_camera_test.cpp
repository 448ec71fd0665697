#include "bench/limits/free_yaw_camera.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/core/rng.hpp"

namespace gnbv {
namespace {

CameraModel camera(double pitch_rad, const Vec3& p_body_m = Vec3::Zero()) {
  CameraConfig config;
  config.pitch_rad = pitch_rad;
  config.p_body_m = p_body_m;
  config.range_max_m = 5.0;
  return make_camera_model(config);
}

/// Whether the point is in the image and range from there; `slack` widens both.
bool is_in_image(const CameraModel& model, const ViewPose& view, const Vec3& point_m,
                 double slack) {
  const CameraConfig& c = model.config;
  const Vec3 p = (T_world_body(view) * model.T_body_camera).inverse() * point_m;
  return p.z() >= c.range_min_m - slack && p.z() <= c.range_max_m + slack &&
         std::abs(p.x()) <= p.z() * std::tan(0.5 * c.fov_x_rad) + slack &&
         std::abs(p.y()) <= p.z() * std::tan(0.5 * c.fov_y_rad) + slack;
}

Vec3 random_point(std::uint64_t index) {
  const auto u = [&](std::uint64_t axis) {
    return 12.0 * uniform01({9, Stream::bench, index, axis}) - 6.0;
  };
  return {u(0), u(1), u(2)};
}

TEST(FreeYawCamera, HasInItsImageWhatSomeYawHas) {
  // the brute force: every tenth of a degree. The bearings tried leave out slivers between them.
  constexpr double kSliver_m = 0.12;
  for (const double pitch_rad : {0.0, 0.35, -0.8}) {
    const CameraModel model = camera(pitch_rad, Vec3(0.1, 0.0, -0.2));
    const FreeYawCamera free_yaw(model);
    int found = 0;
    int missed = 0;
    for (std::uint64_t i = 0; i < 300; ++i) {
      const Vec3 vehicle_m(0.5, -0.3, 0.2);
      const Vec3 point_m = random_point(i);
      bool some_yaw = false;
      bool some_yaw_easily = false;
      for (int k = 0; k < 3600; ++k) {
        const ViewPose view{vehicle_m, 2.0 * kPi * k / 3600.0};
        some_yaw = some_yaw || is_in_image(model, view, point_m, 0.02);
        some_yaw_easily = some_yaw_easily || is_in_image(model, view, point_m, -kSliver_m);
      }
      const auto origin_m = free_yaw.origin_world_m(vehicle_m, point_m);
      EXPECT_TRUE(!origin_m || some_yaw) << i;
      missed += !origin_m && some_yaw_easily ? 1 : 0;
      if (!origin_m) continue;
      ++found;
      EXPECT_NEAR((*origin_m - vehicle_m).norm(), model.config.p_body_m.norm(), 1e-9);
      EXPECT_LE((point_m - vehicle_m).norm(), free_yaw.reach_m());
    }
    EXPECT_GT(found, 30);
    EXPECT_LE(missed, 1) << found;
  }
}

}  // namespace
}  // namespace gnbv
