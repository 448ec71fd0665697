#include "planner/view_sampling.hpp"

#include <algorithm>

namespace gnbv {

std::vector<ViewPose> sample_agvs(const AgvsConfig& config, const ViewPose& current, double scale) {
  const double step_m = config.step_m * scale;
  const Eigen::AngleAxisd R_world_yaw(current.yaw_rad, Vec3::UnitZ());
  std::vector<ViewPose> views;
  for (int ix = -1; ix <= 1; ++ix) {
    for (int iy = -1; iy <= 1; ++iy) {
      for (int iz = -1; iz <= 1; ++iz) {
        const bool same_position = ix == 0 && iy == 0 && iz == 0;
        if (same_position && !(config.rotation_only && scale <= 1.0)) continue;
        const Vec3 p_world_m = current.p_world_m + R_world_yaw * (step_m * Vec3(ix, iy, iz));
        for (int turn = -1; turn <= 1; ++turn) {
          if (same_position && turn == 0) continue;
          views.push_back(
              {p_world_m, wrap_angle_rad(current.yaw_rad + turn * config.yaw_step_rad)});
        }
      }
    }
  }
  return views;
}

double next_agvs_scale(const AgvsConfig& config, double last_scale,
                       std::span<const double> utilities) {
  const auto window = static_cast<std::size_t>(config.utility_window);
  if (window == 0 || utilities.size() < window) return 1.0;
  const std::span<const double> recent = utilities.last(window);
  if (*std::max_element(recent.begin(), recent.end()) >= config.utility_threshold) return 1.0;
  return std::min(last_scale * config.scale_factor, config.scale_max);
}

}  // namespace gnbv
