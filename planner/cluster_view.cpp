#include "planner/cluster_view.hpp"

#include <algorithm>
#include <cmath>

#include "planner/map/ray_walk.hpp"

namespace gnbv {

bool is_in_frustum(const CameraModel& camera, const Isometry& T_world_body, const Vec3& p_world_m) {
  const CameraConfig& config = camera.config;
  const Vec3 p_camera_m = (T_world_body * camera.T_body_camera).inverse() * p_world_m;
  const double depth_m = p_camera_m.z();
  return depth_m >= config.range_min_m && depth_m <= config.range_max_m &&
         std::fabs(p_camera_m.x()) <= depth_m * std::tan(0.5 * config.fov_x_rad) &&
         std::fabs(p_camera_m.y()) <= depth_m * std::tan(0.5 * config.fov_y_rad);
}

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

std::optional<Rejection> cluster_rejection(std::span<const CameraModel> cameras,
                                           const OccupancyGrid& grid,
                                           const FrontierCluster& cluster, const ViewPose& view,
                                           bool needs_visible_cluster) {
  const Isometry T = T_world_body(view);
  const auto has_centroid = [&](const CameraModel& camera) {
    return is_in_frustum(camera, T, cluster.centroid_world_m);
  };
  if (std::none_of(cameras.begin(), cameras.end(), has_centroid)) {
    return Rejection::cluster_outside_fov;
  }
  if (!needs_visible_cluster) return std::nullopt;
  for (const CameraModel& camera : cameras) {
    for (const VoxelIndex v : cluster.voxels) {
      if (sees_voxel(camera, T, grid, v)) return std::nullopt;
    }
  }
  return Rejection::cluster_hidden;
}

}  // namespace gnbv
