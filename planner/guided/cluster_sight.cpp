#include "planner/guided/cluster_sight.hpp"

#include <cmath>
#include <unordered_map>

#include "planner/map/ray_walk.hpp"

namespace gnbv {
namespace {

/// Whether the point (in the camera's frame) lies in the frustum, between the ranges, and not
/// nearer to one of its four sides than `margin_m`.
bool is_in_frustum(const CameraModel& camera, const Vec3& p_camera_m, double margin_m = 0.0) {
  const CameraConfig& config = camera.config;
  if (camera.lens) {
    const double range_m = camera.range_of(p_camera_m);
    if (range_m < config.range_min_m || range_m > config.range_max_m) return false;
    const auto sees = [&](double right_m, double down_m) {
      return camera.lens->sees(p_camera_m + Vec3(right_m, down_m, 0.0));
    };
    return sees(margin_m, 0.0) && sees(-margin_m, 0.0) && sees(0.0, margin_m) &&
           sees(0.0, -margin_m);
  }
  const double depth_m = p_camera_m.z();
  const auto is_inside = [&](double across_m, double fov_rad) {
    const double edge_m = depth_m * std::tan(0.5 * fov_rad) - std::fabs(across_m);
    return edge_m * std::cos(0.5 * fov_rad) >= margin_m;
  };
  return depth_m >= config.range_min_m && depth_m <= config.range_max_m &&
         is_inside(p_camera_m.x(), config.fov_x_rad) && is_inside(p_camera_m.y(), config.fov_y_rad);
}

/// Whether no occupied voxel lies between the point and the voxel's centre.
bool is_clear_before(const OccupancyGrid& grid, const Vec3& from_m, const Vec3& center_m) {
  const GridGeometry& geometry = grid.geometry();
  bool is_clear = true;  // the walk ends before the voxel itself
  walk_ray(geometry, from_m.cast<float>(), center_m.cast<float>(), [&](const Key& key) {
    is_clear =
        !geometry.contains(key) || grid.state(geometry.index_of(key)) != VoxelState::occupied;
    return is_clear;
  });
  return is_clear;
}

/// A camera where the view puts it.
struct PlacedCamera {
  PlacedCamera(const CameraModel& camera, const Isometry& T_world_body)
      : model(camera),
        config(camera.config),
        T_world_camera(T_world_body * camera.T_body_camera),
        T_camera_world(T_world_camera.inverse()) {}

  bool has(const Vec3& p_world_m, double margin_m = 0.0) const {
    return is_in_frustum(model, T_camera_world * p_world_m, margin_m);
  }
  Vec3 origin_m() const { return T_world_camera.translation(); }

  const CameraModel& model;
  const CameraConfig& config;
  Isometry T_world_camera, T_camera_world;
};

/// Marks those of the points in the frustum that no occupied voxel hides; a voxel hides none of its
/// own.
void see_by_map(const PlacedCamera& camera, const OccupancyGrid& grid,
                std::span<const Vec3f> points_m, std::vector<bool>& seen) {
  const GridGeometry& geometry = grid.geometry();
  std::unordered_map<VoxelIndex, bool> is_clear;
  for (std::size_t i = 0; i < points_m.size(); ++i) {
    const Vec3 p_m = points_m[i].cast<double>();
    if (seen[i] || !camera.has(p_m)) continue;
    const Key key = geometry.key_of(p_m);
    const auto [known, is_new] = is_clear.try_emplace(geometry.index_of(key));
    if (is_new) {
      known->second = is_clear_before(grid, camera.origin_m(), geometry.center_m(key));
    }
    seen[i] = known->second;
  }
}

/// The authors' rule: their test of depth compares a squared distance with a length.
void see_by_front(const PlacedCamera& camera, std::span<const Vec3f> points_m,
                  std::vector<bool>& seen) {
  constexpr double kVoxel_m = 0.1;
  constexpr double kDeepest_m2 = kVoxel_m * 1.414;
  const auto voxel_of = [&](const Vec3& p_m) { return cube_of(p_m, kVoxel_m); };
  const auto corner_m = [&](const Key& k) -> Vec3 { return kVoxel_m * Vec3(k[0], k[1], k[2]); };
  std::vector<std::size_t> inside;
  Box3 front_m;
  for (std::size_t i = 0; i < points_m.size(); ++i) {
    const Vec3 p_m = points_m[i].cast<double>();
    if (!camera.has(p_m)) continue;
    inside.push_back(i);
    const Vec3 low_m = corner_m(voxel_of(p_m));
    front_m.extend(low_m);
    front_m.extend(low_m + Vec3::Constant(kVoxel_m));
  }
  for (const std::size_t i : inside) {
    const Vec3 center_m =
        corner_m(voxel_of(points_m[i].cast<double>())) + Vec3::Constant(0.5 * kVoxel_m);
    const Vec3 to_m = center_m - camera.origin_m();
    double enters = 0.0;  // as a share of the way to the voxel
    for (int a = 0; a < 3; ++a) {
      if (to_m[a] == 0.0) continue;
      const double face_m = to_m[a] > 0.0 ? front_m.min()[a] : front_m.max()[a];
      enters = std::max(enters, (face_m - camera.origin_m()[a]) / to_m[a]);
    }
    if (std::pow(1.0 - enters, 2) * to_m.squaredNorm() <= kDeepest_m2) seen[i] = true;
  }
}

}  // namespace

std::optional<Rejection> cluster_rejection(std::span<const CameraModel> cameras,
                                           const OccupancyGrid& grid,
                                           const FrontierCluster& cluster, const ViewPose& view,
                                           bool needs_visible_cluster, double fov_margin_m) {
  const GridGeometry& geometry = grid.geometry();
  bool has_centroid = false;
  bool has_voxel = false;
  for (const CameraModel& model : turned(cameras, view.gimbal_pitch_rad)) {
    const PlacedCamera camera(model, T_world_body(view));
    has_centroid |= camera.has(cluster.centroid_world_m, fov_margin_m);
    for (const VoxelIndex v : cluster.voxels) {
      if (has_voxel || !needs_visible_cluster) break;
      const Vec3 center_m = geometry.center_m(geometry.key_at(v));
      has_voxel = camera.has(center_m) && is_clear_before(grid, camera.origin_m(), center_m);
    }
  }
  if (!has_centroid) return Rejection::cluster_outside_fov;
  if (needs_visible_cluster && !has_voxel) return Rejection::cluster_hidden;
  return std::nullopt;
}

std::vector<bool> points_in_sight(Culling culling, std::span<const CameraModel> cameras,
                                  const OccupancyGrid& grid, const ViewPose& view,
                                  std::span<const Vec3f> points_world_m) {
  std::vector<bool> seen(points_world_m.size());
  for (const CameraModel& model : turned(cameras, view.gimbal_pitch_rad)) {
    const PlacedCamera camera(model, T_world_body(view));
    if (culling == Culling::map) see_by_map(camera, grid, points_world_m, seen);
    if (culling == Culling::front) see_by_front(camera, points_world_m, seen);
  }
  return seen;
}

}  // namespace gnbv
