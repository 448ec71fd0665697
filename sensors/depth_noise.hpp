// How far a measured range is from the true one. Pure functions: the laws, and numbers drawn by
// key.
#pragma once

#include <cstdint>

#include "sensors/camera_model.hpp"
#include "sensors/lidar_model.hpp"

namespace gnbv {

/// What the noise of a measurement is keyed by, beside the sensor and the pixel or beam: the seed
/// of the mission and the tick of the measurement. Noise depends on nothing else.
struct NoiseKey {
  std::uint64_t seed = 0;
  std::uint64_t tick = 0;
};

/// Whether a law of the model asks how slanted the surface is; else any incidence will do.
bool asks_incidence(const DepthNoiseConfig& noise);

/// Standard deviation of the depth of a surface at `depth_m`, whose normal is `incidence_rad` off
/// the ray, in [0, pi / 2]. z is the depth, theta the incidence:
/// none        0
/// released    0.0025 z^2: the authors' sensor_settings.yaml (kucars/nbv_exploration)
/// khoshelham  1.425e-3 z^2: a Kinect's random error (Khoshelham, Elberink, Sensors 2012)
/// nguyen      0.0012 + 0.0019 (z - 0.4)^2, and from 60 degrees on
///             + 0.0001 / sqrt(z) theta^2 / (pi / 2 - theta)^2 (Nguyen, Izadi, Lovell, 3DIMPVT
///             2012)
/// stereo      z^2 s / (f B): a disparity of f B / z with an error of s pixels, to first order
double depth_sigma_m(const CameraModel& camera, double depth_m, double incidence_rad);

/// Standard deviation, along each axis of the image, of where a pixel really looks:
/// 0.8 + 0.035 theta / (pi / 2 - theta) pixels for nguyen (ibid.), constant beyond the angles that
/// return anything; else 0.
double lateral_sigma_px(const DepthNoiseConfig& noise, double incidence_rad);

/// Whether a surface seen at this incidence returns anything at all: nguyen, ibid., measured no
/// surface beyond about 80 degrees.
bool has_return(const DepthNoiseConfig& noise, double incidence_rad);

/// Depth that can be told apart from the maximum range: what lies farther is not traced. Five
/// standard deviations, so that one pixel in three million would be told otherwise. (Much farther
/// out the laws, which hold near the working range, would give errors as large as the depth.)
double farthest_m(const CameraModel& camera);
double farthest_m(const LidarConfig& lidar);

/// Standard normal numbers, each of its own.
double depth_deviate(const NoiseKey& key, int camera, std::uint64_t pixel);
double lateral_deviate(const NoiseKey& key, int camera, std::uint64_t pixel, int axis);
double range_deviate(const NoiseKey& key, int lidar, std::uint64_t beam);

}  // namespace gnbv
