// How far a measured depth is from the true one.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "sensors/camera_model.hpp"
#include "sim/core/error.hpp"

namespace gnbv {

/// Noise depends on these, the sensor and the pixel or beam, and on nothing else.
struct NoiseKey {
  std::uint64_t seed = 0;  // of the mission
  std::uint64_t tick = 0;  // of the measurement
};

/// Whether the model depends on how slanted the surface is.
inline bool asks_incidence(const DepthNoiseConfig& noise) {
  return noise.model == DepthNoise::nguyen;
}

/// Standard deviation of the depth z of a surface whose normal is theta = `incidence_rad` off the
/// ray, in [0, pi / 2].
inline double depth_sigma_m(const CameraModel& camera, double depth_m, double incidence_rad) {
  const auto square = [](double x) { return x * x; };
  const DepthNoiseConfig& noise = camera.config.noise;
  switch (noise.model) {
    case DepthNoise::none:
      return 0.0;
    case DepthNoise::released:  // the authors' sensor_settings.yaml (kucars/nbv_exploration)
      return 0.0025 * square(depth_m);
    case DepthNoise::khoshelham:  // a Kinect's random error (Khoshelham, Elberink, Sensors 2012)
      return 1.425e-3 * square(depth_m);
    case DepthNoise::nguyen: {  // Nguyen, Izadi, Lovell, 3DIMPVT 2012
      const double facing_m = 0.0012 + 0.0019 * square(depth_m - 0.4);
      if (incidence_rad <= deg_to_rad(60.0)) return facing_m;
      return facing_m + 0.0001 / std::sqrt(depth_m) * square(incidence_rad) /
                            square(0.5 * kPi - incidence_rad);
    }
    case DepthNoise::stereo:  // z = f B / disparity, with an error of s pixels: z^2 s / (f B)
      return square(depth_m) * noise.disparity_noise_px / (camera.fx_px * noise.baseline_m);
  }
  throw BrokenInvariant("depth noise outside its enumeration");
}

/// Nguyen et al. measured no surface beyond about this incidence.
constexpr double kGrazing_rad = deg_to_rad(80.0);

/// Whether a surface at this incidence returns anything.
inline bool has_return(const DepthNoiseConfig& noise, double incidence_rad) {
  return !asks_incidence(noise) || incidence_rad <= kGrazing_rad;
}

/// Standard deviation of where a pixel really looks, along each axis of the image (Nguyen et al.;
/// constant where nothing returns); 0 for the other models.
inline double lateral_sigma_px(const DepthNoiseConfig& noise, double incidence_rad) {
  if (!asks_incidence(noise)) return 0.0;
  const double theta_rad = std::min(incidence_rad, kGrazing_rad);
  return 0.8 + 0.035 * theta_rad / (0.5 * kPi - theta_rad);
}

}  // namespace gnbv
