#include "planner/guided/view_sampling.hpp"

#include <algorithm>
#include <cmath>

#include "planner/map/ray_walk.hpp"

namespace gnbv {
namespace {

/// The view with every pitch, or with the one it has where there are none to choose from.
std::vector<ViewPose> pitched(const ViewPose& view, std::span<const double> pitches_rad) {
  std::vector<ViewPose> views(std::max<std::size_t>(pitches_rad.size(), 1), view);
  for (std::size_t i = 0; i < pitches_rad.size(); ++i) views[i].gimbal_pitch_rad = pitches_rad[i];
  return views;
}

// ---- frontiers

/// Whether the point lies in the camera's frustum, between its ranges.
bool is_in_frustum(const CameraModel& camera, const Isometry& T_world_body, const Vec3& p_world_m) {
  const CameraConfig& config = camera.config;
  const Vec3 p_camera_m = (T_world_body * camera.T_body_camera).inverse() * p_world_m;
  const double depth_m = p_camera_m.z();
  return depth_m >= config.range_min_m && depth_m <= config.range_max_m &&
         std::fabs(p_camera_m.x()) <= depth_m * std::tan(0.5 * config.fov_x_rad) &&
         std::fabs(p_camera_m.y()) <= depth_m * std::tan(0.5 * config.fov_y_rad);
}

/// Whether the camera sees the voxel's centre: in the frustum, no occupied voxel before it.
bool sees_voxel(const CameraModel& camera, const Isometry& T_world_body, const OccupancyGrid& grid,
                VoxelIndex v) {
  const GridGeometry& geometry = grid.geometry();
  const Vec3 center_m = geometry.center_m(geometry.key_at(v));
  if (!is_in_frustum(camera, T_world_body, center_m)) return false;
  const Vec3 origin_m = T_world_body * camera.T_body_camera.translation();
  bool is_clear = true;  // the walk ends before the voxel itself
  walk_ray(geometry, origin_m.cast<float>(), center_m.cast<float>(), [&](const Key& key) {
    is_clear =
        !geometry.contains(key) || grid.state(geometry.index_of(key)) != VoxelState::occupied;
    return is_clear;
  });
  return is_clear;
}

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
    if (is_here && !(config.rotation_only && scale <= 1.0)) return;
    const bool is_current = is_here && turn == 0;
    ViewPose view = current;
    if (!is_current) {
      view.p_world_m += R_world_yaw * (step_m * Vec3(ix, iy, iz));
      view.yaw_rad = wrap_angle_rad(current.yaw_rad + turn * config.yaw_step_rad);
    }
    for (const ViewPose& one : pitched(view, pitches_rad)) {
      const double pitch_rad = one.gimbal_pitch_rad - current.gimbal_pitch_rad;
      if (!is_current || std::fabs(pitch_rad) > kSamePitch_rad) views.push_back(one);
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
  for (int layer = -1; layer <= 1; ++layer) {
    for (int i = 0; i < config.views_per_layer; ++i) {
      const double bearing_rad = 2.0 * kPi * i / config.views_per_layer;
      const Vec3 outwards(std::cos(bearing_rad), std::sin(bearing_rad), 0.0);
      const Vec3 p_world_m = centroid_world_m + config.radius_m * outwards +
                             layer * config.layer_step_m * Vec3::UnitZ();
      const auto here = pitched({p_world_m, wrap_angle_rad(bearing_rad + kPi)}, pitches_rad);
      views.insert(views.end(), here.begin(), here.end());
    }
  }
  return views;
}

std::vector<FrontierCluster> clusters_to_try(const FvsConfig& fvs, const Belief& belief,
                                             std::span<const Decision> decisions,
                                             const Vec3& from_world_m, FrontierMarks& marks) {
  constexpr double kSame_voxels = 3.0;
  std::vector<FrontierCluster> clusters =
      find_frontiers(fvs.frontier, belief.grid, belief.cloud, marks);
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
  return clusters;
}

std::optional<Rejection> cluster_rejection(std::span<const CameraModel> cameras,
                                           const OccupancyGrid& grid,
                                           const FrontierCluster& cluster, const ViewPose& view,
                                           bool needs_visible_cluster) {
  const Isometry T = T_world_body(view);
  const std::vector<CameraModel> looking = turned(cameras, view.gimbal_pitch_rad);
  const auto has_centroid = [&](const CameraModel& camera) {
    return is_in_frustum(camera, T, cluster.centroid_world_m);
  };
  if (std::none_of(looking.begin(), looking.end(), has_centroid)) {
    return Rejection::cluster_outside_fov;
  }
  if (!needs_visible_cluster) return std::nullopt;
  for (const CameraModel& camera : looking) {
    for (const VoxelIndex v : cluster.voxels) {
      if (sees_voxel(camera, T, grid, v)) return std::nullopt;
    }
  }
  return Rejection::cluster_hidden;
}

bool is_entropy_still(double threshold_nat, int window, const History& history,
                      double view_voxels) {
  const std::vector<double>& all_nat = history.entropies_nat;
  const auto changes = static_cast<std::size_t>(window);
  if (threshold_nat <= 0.0 || all_nat.size() < changes + 1) return false;
  for (std::size_t i = all_nat.size() - changes; i < all_nat.size(); ++i) {
    if (std::fabs(all_nat[i] - all_nat[i - 1]) / view_voxels >= threshold_nat) return false;
  }
  return true;
}

double next_agvs_scale(const AgvsConfig& config, const History& history, double view_voxels) {
  const std::span<const Decision> decisions = history.decisions;
  const bool is_at_minimum =
      is_utility_low(config, decisions) || is_back_and_forth(decisions, config.repeated_moves) ||
      is_entropy_still(config.entropy_threshold_nat, config.entropy_window, history, view_voxels);
  if (!config.scales || !is_at_minimum) return 1.0;
  const double last_scale = decisions.empty() ? 1.0 : decisions.back().scale;
  return std::min(last_scale * config.scale_factor, config.scale_max);
}

}  // namespace gnbv
