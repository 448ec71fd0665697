#include "planner/guided/frontier_clusters.hpp"

#include <algorithm>
#include <cmath>

#include "planner/core/belief.hpp"
#include "planner/guided/view_sampling.hpp"
#include "planner/map/ray_walk.hpp"
#include "sensors/camera_model.hpp"

namespace gnbv {
namespace {

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

bool is_looked_at_enough(const FvsConfig& fvs, std::span<const Decision> decisions,
                         const FrontierCluster& cluster, double resolution_m) {
  constexpr double kSame_voxels = 3.0;
  const auto looks = std::count_if(decisions.begin(), decisions.end(), [&](const Decision& d) {
    return traits_of(d.sampler).at_frontier &&
           looks_at(fvs, d.view, cluster.centroid_world_m, kSame_voxels * resolution_m);
  });
  return looks >= fvs.looks_max;
}

}  // namespace

std::vector<FrontierCluster> clusters_to_try(const FvsConfig& fvs, const Belief& belief,
                                             std::span<const Decision> decisions,
                                             const Vec3& from_world_m, FrontierMarks& marks) {
  std::vector<FrontierCluster> clusters =
      find_frontiers(fvs.frontier, belief.grid, belief.cloud, marks);
  if (fvs.looks_max > 0) {
    const double resolution_m = belief.grid.geometry().resolution_m();
    std::erase_if(clusters, [&](const FrontierCluster& cluster) {
      return is_looked_at_enough(fvs, decisions, cluster, resolution_m);
    });
  }
  const auto is_nearer = [&](const FrontierCluster& a, const FrontierCluster& b) {
    return (a.centroid_world_m - from_world_m).squaredNorm() <
           (b.centroid_world_m - from_world_m).squaredNorm();
  };
  std::stable_sort(clusters.begin(), clusters.end(), is_nearer);
  if (fvs.order == ClusterOrder::largest) {
    std::stable_sort(clusters.begin(), clusters.end(),
                     [](const FrontierCluster& a, const FrontierCluster& b) {
                       return a.voxels.size() > b.voxels.size();
                     });
  }
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

}  // namespace gnbv
