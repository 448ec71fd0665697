#include "planner/guided/view_sampling.hpp"

#include <algorithm>
#include <cmath>

namespace gnbv {
namespace {

/// The view with every pitch, or with the one it has where there are none to choose from.
std::vector<ViewPose> pitched(const ViewPose& view, std::span<const double> pitches_rad) {
  std::vector<ViewPose> views(std::max<std::size_t>(pitches_rad.size(), 1), view);
  for (std::size_t i = 0; i < pitches_rad.size(); ++i) views[i].gimbal_pitch_rad = pitches_rad[i];
  return views;
}

// ---- frontiers

/// Whether a view of sample_fvs() was one of this centroid's, or of one no further than `apart_m`
/// from it.
bool looks_at(const FvsConfig& config, const ViewPose& view, const Vec3& centroid_world_m,
              double apart_m) {
  const Vec3 ahead(std::cos(view.yaw_rad), std::sin(view.yaw_rad), 0.0);
  Vec3 away_m = view.p_world_m + config.radius_m * ahead - centroid_world_m;
  // of the three layers the one that is nearest
  const double layer_m = std::clamp(away_m.z(), -config.layer_step_m, config.layer_step_m);
  away_m.z() -= layer_m;
  return away_m.norm() <= apart_m;
}

// ---- local minima

bool is_utility_low(const AgvsConfig& config, std::span<const Decision> decisions) {
  int scored = 0;
  for (auto last = decisions.rbegin(); last != decisions.rend(); ++last) {
    if (scored == config.utility_window) break;
    if (!traits_of(last->sampler).is_scored) continue;
    if (last->score.value >= config.utility_threshold) return false;
    ++scored;
  }
  return scored == config.utility_window;
}

}  // namespace

std::vector<ViewPose> sample_agvs(const AgvsConfig& config, const ViewPose& current, double scale,
                                  std::span<const double> pitches_rad) {
  constexpr double kSamePitch_rad = 1e-9;
  const double step_m = config.step_m * scale;
  const Eigen::AngleAxisd R_world_yaw(current.yaw_rad, Vec3::UnitZ());
  std::vector<ViewPose> views;
  const auto add = [&](int ix, int iy, int iz, int turn) {
    const bool is_here = ix == 0 && iy == 0 && iz == 0;
    const bool is_finest = scale <= 1.0;
    const bool may_turn = config.rotation_only && (is_finest || config.rotation_at_all_scales);
    if (is_here && !may_turn) return;
    const bool is_current = is_here && turn == 0;
    const bool may_stay = is_finest && config.current_pose;
    ViewPose view = current;
    if (!is_current) {
      view.p_world_m += R_world_yaw * (step_m * Vec3(ix, iy, iz));
      view.yaw_rad = wrap_angle_rad(current.yaw_rad + turn * config.yaw_step_rad);
    }
    for (const ViewPose& one : pitched(view, pitches_rad)) {
      const double pitch_rad = one.gimbal_pitch_rad - current.gimbal_pitch_rad;
      const bool stays = is_current && std::fabs(pitch_rad) <= kSamePitch_rad;
      if (!stays || may_stay) views.push_back(one);
    }
  };
  for (int ix = -1; ix <= 1; ++ix) {
    for (int iy = -1; iy <= 1; ++iy) {
      for (int iz = -1; iz <= 1; ++iz) {
        for (int turn = -1; turn <= 1; ++turn) add(ix, iy, iz, turn);
      }
    }
  }
  return views;
}

std::vector<ViewPose> sample_fvs(const FvsConfig& config, const Vec3& centroid_world_m,
                                 std::span<const double> pitches_rad) {
  std::vector<ViewPose> views;
  const int bearings = config.views_per_layer + (config.first_bearing_twice ? 1 : 0);
  for (int layer = -1; layer <= 1; ++layer) {
    for (int i = 0; i < bearings; ++i) {
      const double bearing_rad = 2.0 * kPi * (i % config.views_per_layer) / config.views_per_layer;
      const Vec3 outwards(std::cos(bearing_rad), std::sin(bearing_rad), 0.0);
      const Vec3 p_world_m = centroid_world_m + config.radius_m * outwards +
                             layer * config.layer_step_m * Vec3::UnitZ();
      const auto here = pitched({p_world_m, wrap_angle_rad(bearing_rad + kPi)}, pitches_rad);
      views.insert(views.end(), here.begin(), here.end());
    }
  }
  return views;
}

void set_mode_switches(FvsConfig& config) {
  const FvsConfig burst;
  const bool is_single = config.mode == FvsMode::single;
  const auto set = [&](auto& value, const auto& single, const auto& of_burst) {
    value = is_single ? single : of_burst;
  };
  FrontierConfig& frontier = config.frontier;
  set(config.entropy_window, 4, burst.entropy_window);
  set(config.entropy_lag, 0, burst.entropy_lag);
  set(config.voxels_in_view, VoxelsInView::frusta, burst.voxels_in_view);
  set(config.radius_m, 3.5, burst.radius_m);
  set(config.needs_visible_cluster, true, burst.needs_visible_cluster);
  set(frontier.occupied_only, true, burst.frontier.occupied_only);
  set(frontier.linking, FrontierLinking::chebyshev, burst.frontier.linking);
  set(frontier.max_cluster_voxels, 0, burst.frontier.max_cluster_voxels);
  set(frontier.max_extent_m, 2.0, burst.frontier.max_extent_m);
}

void find_clusters_to_try(const FvsConfig& fvs, const Belief& belief,
                          std::span<const Decision> decisions, const Vec3& from_world_m,
                          FrontierMarks& marks, Plan& plan) {
  constexpr double kSame_voxels = 3.0;
  std::vector<FrontierCluster>& clusters = plan.clusters;
  clusters = find_frontiers(fvs.frontier, belief.grid, belief.cloud, marks);
  plan.frontier = voxels_of(clusters);
  const double apart_m = kSame_voxels * belief.grid.geometry().resolution_m();
  const auto is_looked_at_enough = [&](const FrontierCluster& cluster) {
    return fvs.looks_max <=
           std::count_if(decisions.begin(), decisions.end(), [&](const Decision& d) {
             return traits_of(d.sampler).at_frontier &&
                    looks_at(fvs, d.view, cluster.centroid_world_m, apart_m);
           });
  };
  if (fvs.looks_max > 0) std::erase_if(clusters, is_looked_at_enough);
  const auto distance2_m2 = [&](const FrontierCluster& cluster) {
    return (cluster.centroid_world_m - from_world_m).squaredNorm();
  };
  const auto comes_first = [&](const FrontierCluster& a, const FrontierCluster& b) {
    const bool is_by_size =
        fvs.order == ClusterOrder::largest && a.voxels.size() != b.voxels.size();
    return is_by_size ? a.voxels.size() > b.voxels.size() : distance2_m2(a) < distance2_m2(b);
  };
  std::stable_sort(clusters.begin(), clusters.end(), comes_first);
  clusters.resize(std::min(clusters.size(), static_cast<std::size_t>(fvs.tries)));
}

double voxels_in_view(VoxelsInView which, const PlannerModel& model) {
  if (which == VoxelsInView::frusta) return model.view_voxels;
  const CameraConfig& c = model.sights.front().config;
  const double beyond = std::pow(c.range_min_m / c.range_max_m, 3);
  return 0.25 * frustum_m3(c) * (1.0 - beyond) / std::pow(model.belief.map.resolution_m, 3);
}

bool is_entropy_still(double threshold_nat, int window, int lag, const History& history,
                      double view_voxels) {
  const std::vector<double>& all_nat = history.entropies_nat;
  const auto changes = static_cast<std::size_t>(window);
  const auto left_out = static_cast<std::size_t>(lag);
  if (threshold_nat <= 0.0 || all_nat.size() < changes + left_out + 1) return false;
  const std::size_t end = all_nat.size() - left_out;
  for (std::size_t i = end - changes; i < end; ++i) {
    if (std::fabs(all_nat[i] - all_nat[i - 1]) / view_voxels >= threshold_nat) return false;
  }
  return true;
}

double next_agvs_scale(const AgvsConfig& config, const History& history, double view_voxels) {
  const std::span<const Decision> decisions = history.decisions;
  const bool is_at_minimum =
      is_utility_low(config, decisions) ||
      is_back_and_forth(config.repeated_by, decisions, config.repeated_moves) ||
      is_entropy_still(config.entropy_threshold_nat, config.entropy_window, 0, history,
                       view_voxels);
  if (!config.scales || !is_at_minimum) return 1.0;
  const double last_scale = decisions.empty() ? 1.0 : decisions.back().scale;
  return std::min(last_scale * config.scale_factor, config.scale_max);
}

}  // namespace gnbv
