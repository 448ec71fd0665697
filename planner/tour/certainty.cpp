#include "planner/tour/certainty.hpp"

#include <algorithm>
#include <cmath>

#include "planner/core/belief.hpp"
#include "sensors/depth_noise.hpp"

namespace gnbv {

double certainty(const CameraModel& camera, double depth_m, double within_m) {
  const double sigma_m = depth_sigma_m(camera, depth_m, 0.0);
  return sigma_m > 0.0 ? std::erf(within_m / (std::sqrt(2.0) * sigma_m)) : 1.0;
}

std::uint8_t certainty_bin(double certainty) {
  return static_cast<std::uint8_t>(std::find_if(kCertaintyFrom.begin(), kCertaintyFrom.end(),
                                                [&](double from) { return certainty >= from; }) -
                                   kCertaintyFrom.begin());
}

std::vector<float> certainties(std::span<const Vec3f> points_world_m,
                               std::span<const FramePose> looks,
                               std::span<const CameraModel> cameras, double within_m) {
  const auto is_exact = [](const CameraModel& camera) {
    return camera.config.noise.model == DepthNoise::none;
  };
  if (std::all_of(cameras.begin(), cameras.end(), is_exact)) return {};
  std::vector<Isometry> T_camera_world;
  for (const FramePose& look : looks) T_camera_world.push_back(look.T_world_camera.inverse());
  std::vector<float> found(points_world_m.size(), 1.0F);
  for (std::size_t i = 0; i < points_world_m.size(); ++i) {
    for (std::size_t j = 0; j < looks.size(); ++j) {
      const CameraModel& camera = cameras[static_cast<std::size_t>(looks[j].camera)];
      const Vec3 p_camera_m = T_camera_world[j] * points_world_m[i].cast<double>();
      const double range_m = camera.range_of(p_camera_m);
      const bool is_in_range =
          range_m >= camera.config.range_min_m && range_m <= return_end_m(camera.config);
      if (p_camera_m.z() <= 0.0 || !is_in_range || !camera.has_in_image(p_camera_m)) continue;
      found[i] = static_cast<float>(certainty(camera, p_camera_m.z(), within_m));
      break;
    }
  }
  return found;
}

}  // namespace gnbv
