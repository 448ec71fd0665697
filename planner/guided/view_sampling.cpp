#include "planner/guided/view_sampling.hpp"

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

constexpr double kSamePitch_rad = 1e-9;

/// Adds the view with every pitch, or with the one it has where there are none to choose from.
void add_pitched(ViewPose view, std::span<const double> pitches_rad, std::vector<ViewPose>& views) {
  if (pitches_rad.empty()) views.push_back(view);
  for (const double pitch_rad : pitches_rad) {
    view.gimbal_pitch_rad = pitch_rad;
    views.push_back(view);
  }
}

/// The current pose is no candidate, but for another pitch of the gimbal.
void add_other_pitches(ViewPose current, std::span<const double> pitches_rad,
                       std::vector<ViewPose>& views) {
  const double had_rad = current.gimbal_pitch_rad;
  for (const double pitch_rad : pitches_rad) {
    current.gimbal_pitch_rad = pitch_rad;
    if (std::fabs(pitch_rad - had_rad) > kSamePitch_rad) views.push_back(current);
  }
}

}  // namespace

std::vector<ViewPose> sample_agvs(const AgvsConfig& config, const ViewPose& current, double scale,
                                  std::span<const double> pitches_rad) {
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
          if (same_position && turn == 0) {
            add_other_pitches(current, pitches_rad, views);
            continue;
          }
          add_pitched({p_world_m, wrap_angle_rad(current.yaw_rad + turn * config.yaw_step_rad),
                       current.gimbal_pitch_rad},
                      pitches_rad, views);
        }
      }
    }
  }
  return views;
}

std::vector<ViewPose> sample_fvs(const FvsConfig& config, const Vec3& centroid_world_m,
                                 std::span<const double> pitches_rad) {
  std::vector<ViewPose> views;
  for (int layer = -1; layer <= 1; ++layer) {
    for (int i = 0; i < config.views_per_layer; ++i) {
      const double bearing_rad = 2.0 * kPi * i / config.views_per_layer;
      const Vec3 outwards(std::cos(bearing_rad), std::sin(bearing_rad), 0.0);
      const Vec3 p_world_m = centroid_world_m + config.radius_m * outwards +
                             layer * config.layer_step_m * Vec3::UnitZ();
      add_pitched({p_world_m, wrap_angle_rad(bearing_rad + kPi)}, pitches_rad, views);
    }
  }
  return views;
}

bool looks_at(const FvsConfig& config, const ViewPose& view, const Vec3& centroid_world_m,
              double apart_m) {
  const Vec3 ahead(std::cos(view.yaw_rad), std::sin(view.yaw_rad), 0.0);
  Vec3 away_m = view.p_world_m + config.radius_m * ahead - centroid_world_m;
  // of the three layers the one that is nearest
  const double layer_m = std::clamp(away_m.z(), -config.layer_step_m, config.layer_step_m);
  away_m.z() -= layer_m;
  return away_m.norm() <= apart_m;
}

bool is_entropy_still(double threshold_nat, int window, const Progress& progress) {
  const auto changes = static_cast<std::size_t>(window);
  if (threshold_nat <= 0.0 || progress.entropies_nat.size() < changes + 1) return false;
  const std::span<const double> recent = progress.entropies_nat.last(changes + 1);
  double largest_nat = 0.0;
  for (std::size_t i = 1; i < recent.size(); ++i) {
    largest_nat = std::max(largest_nat, std::fabs(recent[i] - recent[i - 1]));
  }
  return largest_nat / progress.view_voxels < threshold_nat;
}

double next_agvs_scale(const AgvsConfig& config, double last_scale, const Progress& progress) {
  const bool is_at_minimum =
      is_utility_low(config, progress.utilities) ||
      is_back_and_forth(progress.positions_m, config.repeated_moves) ||
      is_entropy_still(config.entropy_threshold_nat, config.entropy_window, progress);
  if (!config.scales || !is_at_minimum) return 1.0;
  return std::min(last_scale * config.scale_factor, config.scale_max);
}

}  // namespace gnbv
