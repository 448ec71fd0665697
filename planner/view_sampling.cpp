#include "planner/view_sampling.hpp"

#include <algorithm>
#include <cmath>

namespace gnbv {

namespace {

bool is_utility_low(const AgvsConfig& config, std::span<const double> utilities) {
  const auto window = static_cast<std::size_t>(config.utility_window);
  if (utilities.size() < window) return false;
  const std::span<const double> recent = utilities.last(window);
  return *std::max_element(recent.begin(), recent.end()) < config.utility_threshold;
}

bool is_entropy_still(const AgvsConfig& config, const Progress& progress) {
  const auto window = static_cast<std::size_t>(config.entropy_window);
  if (progress.entropies_nat.size() < window + 1) return false;
  const std::span<const double> recent = progress.entropies_nat.last(window + 1);
  double largest_nat = 0.0;
  for (std::size_t i = 1; i < recent.size(); ++i) {
    largest_nat = std::max(largest_nat, std::fabs(recent[i] - recent[i - 1]));
  }
  return largest_nat / progress.view_voxels < config.entropy_threshold_nat;
}

}  // namespace

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

double next_agvs_scale(const AgvsConfig& config, double last_scale, const Progress& progress) {
  if (!is_utility_low(config, progress.utilities) && !is_entropy_still(config, progress)) {
    return 1.0;
  }
  return std::min(last_scale * config.scale_factor, config.scale_max);
}

}  // namespace gnbv
