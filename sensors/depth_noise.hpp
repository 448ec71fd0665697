// How far a measured depth is from the true one.
#pragma once

#include <cstdint>

#include "sensors/camera_model.hpp"

namespace gnbv {

/// Noise depends on these, the sensor and the pixel or beam, and on nothing else.
struct NoiseKey {
  std::uint64_t seed = 0;  // of the mission
  std::uint64_t tick = 0;  // of the measurement
};

/// Whether the model depends on how slanted the surface is.
bool asks_incidence(const DepthNoiseConfig& noise);

/// Standard deviation of the depth z of a surface whose normal is theta = `incidence_rad` off the
/// ray, in [0, pi / 2]:
/// none        0
/// released    0.0025 z^2: the authors' sensor_settings.yaml (kucars/nbv_exploration)
/// khoshelham  1.425e-3 z^2: a Kinect's random error (Khoshelham, Elberink, Sensors 2012)
/// nguyen      0.0012 + 0.0019 (z - 0.4)^2, and from 60 degrees on
///             + 0.0001 / sqrt(z) theta^2 / (pi / 2 - theta)^2 (Nguyen, Izadi, Lovell, 3DIMPVT
///             2012)
/// stereo      z^2 s / (f B): a disparity of f B / z with an error of s pixels, to first order
double depth_sigma_m(const CameraModel& camera, double depth_m, double incidence_rad);

/// Standard deviation of where a pixel really looks, along each axis of the image:
/// 0.8 + 0.035 theta / (pi / 2 - theta) pixels for nguyen (ibid.), constant from 80 degrees on;
/// else 0.
double lateral_sigma_px(const DepthNoiseConfig& noise, double incidence_rad);

/// Whether a surface at this incidence returns anything: nguyen (ibid.) measured none beyond about
/// 80 degrees.
bool has_return(const DepthNoiseConfig& noise, double incidence_rad);

}  // namespace gnbv
