// A planar scanning LIDAR on the body. Header only, as camera_model.hpp.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "sim/core/pose.hpp"

namespace gnbv {

/// Defaults: the profiling laser of the paper (180 degrees, 0.1-30 m) with the beams and rate of
/// the released floating_sensor.sdf, tilted down so that it gives the paper's profile.
struct LidarConfig {
  std::string preset = "profiling_sim";  // a label: the sensor whose values these began as
  std::string name = "lidar";
  int beams = 720;
  double fov_rad = kPi;
  double rate_hz = 40.0;
  double range_min_m = 0.1;
  double range_max_m = 30.0;
  Vec3 p_body_m = Vec3::Zero();
  double roll_rad = 0.0;                // about body x, applied first
  double pitch_rad = deg_to_rad(10.0);  // about body y: positive tilts the fan down; second
  double yaw_rad = 0.0;                 // about body z, applied last
  double range_sigma_m = 0.0;           // of each range
  /// Whether the beams of a sweep are taken one after the other (in fov / 2 pi of a period) while
  /// the vehicle moves; else all at once.
  bool rolling = false;
};

/// From the first beam of a sweep to its last: the head turns evenly, once a period.
inline double sweep_duration_s(const LidarConfig& config) {
  return config.rolling ? config.fov_rad / (2.0 * kPi * config.rate_hz) : 0.0;
}

/// LIDAR frame: FLU, beams in its x-y plane, counter-clockwise from -fov/2 to +fov/2 inclusive.
inline Isometry T_body_lidar(const LidarConfig& config) {
  return mounted(config.p_body_m, config.roll_rad, config.pitch_rad, config.yaw_rad);
}

/// Unit direction of a beam in the LIDAR frame.
inline Vec3f beam_lidar(const LidarConfig& config, int beam) {
  const double step_rad = config.beams > 1 ? config.fov_rad / (config.beams - 1) : 0.0;
  const double azimuth_rad = -0.5 * config.fov_rad + beam * step_rad;
  return {static_cast<float>(std::cos(azimuth_rad)), static_cast<float>(std::sin(azimuth_rad)),
          0.0F};
}

/// Geometry of a LidarConfig.
struct LidarModel {
  LidarConfig config;
  Isometry T_body_lidar = Isometry::Identity();
  std::vector<Vec3f> beams_lidar;  // beam_lidar() of every beam
};

inline LidarModel make_lidar_model(const LidarConfig& config) {
  LidarModel model = {config, T_body_lidar(config), {}};
  for (int beam = 0; beam < config.beams; ++beam) {
    model.beams_lidar.push_back(beam_lidar(config, beam));
  }
  return model;
}

}  // namespace gnbv
