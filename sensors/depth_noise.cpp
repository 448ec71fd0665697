#include "sensors/depth_noise.hpp"

#include <algorithm>
#include <cmath>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

constexpr double kSteep_rad = deg_to_rad(60.0);
constexpr double kGrazing_rad = deg_to_rad(80.0);

double square(double x) { return x * x; }

}  // namespace

bool asks_incidence(const DepthNoiseConfig& noise) { return noise.model == DepthNoise::nguyen; }

double depth_sigma_m(const CameraModel& camera, double depth_m, double incidence_rad) {
  const DepthNoiseConfig& noise = camera.config.noise;
  switch (noise.model) {
    case DepthNoise::none:
      return 0.0;
    case DepthNoise::released:
      return 0.0025 * square(depth_m);
    case DepthNoise::khoshelham:
      return 1.425e-3 * square(depth_m);
    case DepthNoise::nguyen: {
      const double facing_m = 0.0012 + 0.0019 * square(depth_m - 0.4);
      if (incidence_rad <= kSteep_rad) return facing_m;
      return facing_m + 0.0001 / std::sqrt(depth_m) * square(incidence_rad) /
                            square(0.5 * kPi - incidence_rad);
    }
    case DepthNoise::stereo:
      return square(depth_m) * noise.disparity_noise_px / (camera.fx_px * noise.baseline_m);
  }
  throw BrokenInvariant("depth noise outside its enumeration");
}

double lateral_sigma_px(const DepthNoiseConfig& noise, double incidence_rad) {
  if (!asks_incidence(noise)) return 0.0;
  const double theta_rad = std::min(incidence_rad, kGrazing_rad);
  return 0.8 + 0.035 * theta_rad / (0.5 * kPi - theta_rad);
}

bool has_return(const DepthNoiseConfig& noise, double incidence_rad) {
  return !asks_incidence(noise) || incidence_rad <= kGrazing_rad;
}

}  // namespace gnbv
