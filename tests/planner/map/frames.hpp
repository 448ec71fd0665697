// Depth frames of the map tests, most of them such as no scene would give.
#pragma once

#include <vector>

#include "sensors/camera_model.hpp"
#include "sensors/frames.hpp"
#include "tests/planner/map/random_points.hpp"

namespace gnbv {

inline CameraModel camera_of(int width_px, int height_px, double fov_x_deg, double fov_y_deg) {
  return make_camera_model({.width_px = width_px,
                            .height_px = height_px,
                            .fov_x_rad = deg_to_rad(fov_x_deg),
                            .fov_y_rad = deg_to_rad(fov_y_deg)});
}

/// Any position in the box and any attitude.
inline Isometry random_pose(Random& random, const Box3& box_m) {
  Isometry T = Isometry::Identity();
  T.translate(random.point_in(box_m).cast<double>());
  T.rotate(Eigen::AngleAxisd(random.uniform(-kPi, kPi), Vec3::UnitZ()));
  T.rotate(Eigen::AngleAxisd(random.uniform(-kPi, kPi), Vec3::UnitY()));
  T.rotate(Eigen::AngleAxisd(random.uniform(-kPi, kPi), Vec3::UnitX()));
  return T;
}

/// Depths of a plane through what the middle pixel sees at `depth_m`, tilted by `slope` in u and v.
inline std::vector<float> plane_depths(const CameraModel& camera, double depth_m, double slope) {
  std::vector<float> depths_m;
  for (int v = 0; v < camera.config.height_px; ++v) {
    for (int u = 0; u < camera.config.width_px; ++u) {
      const Vec3f ray = camera.ray_camera(u, v);
      const double z_m = depth_m / (1.0 - slope * static_cast<double>(ray.x() + ray.y()));
      depths_m.push_back(z_m > 0.0 && z_m < 9.0 ? static_cast<float>(z_m) : kNoReturn);
    }
  }
  return depths_m;
}

/// Each pixel on its own: a quarter invalid, a quarter without return, some out of range.
inline std::vector<float> noise_depths(Random& random, const CameraModel& camera) {
  std::vector<float> depths_m;
  for (int i = 0; i < camera.config.width_px * camera.config.height_px; ++i) {
    const double kind = random.uniform(0.0, 4.0);
    depths_m.push_back(kind < 1.0   ? kInvalidRange
                       : kind < 2.0 ? kNoReturn
                                    : static_cast<float>(random.uniform(0.0, 9.0)));
  }
  return depths_m;
}

}  // namespace gnbv
