#include "planner/model.hpp"

#include <cmath>

#include "planner/tour_planner.hpp"

namespace gnbv {
namespace {

/// Volume of the pyramids up to maximum range, in voxels.
double frustum_voxels(std::span<const CameraModel> cameras, double resolution_m) {
  double volume_m3 = 0.0;
  for (const CameraModel& camera : cameras) {
    const CameraConfig& c = camera.config;
    volume_m3 += 4.0 / 3.0 * std::tan(0.5 * c.fov_x_rad) * std::tan(0.5 * c.fov_y_rad) *
                 std::pow(c.range_max_m, 3);
  }
  return volume_m3 / std::pow(resolution_m, 3);
}

}  // namespace

PlannerModel::PlannerModel(const PlannerConfig& planner_config, const Box3& workspace,
                           std::span<const CameraModel> camera_models,
                           std::span<const LidarModel> lidar_models, std::uint64_t mission_seed)
    : config(planner_config),
      seed(mission_seed),
      workspace_m(workspace),
      navigation_m(navigation_box_m(planner_config.validity, workspace)),
      cameras(camera_models.begin(), camera_models.end()),
      lidars(lidar_models.begin(), lidar_models.end()),
      view_rays(make_view_rays(cameras, planner_config.map.resolution_m)),
      view_voxels(frustum_voxels(cameras, planner_config.map.resolution_m)),
      needs_shadow(!is_tour(config.utility.name) && !is_route(config.utility.name) && !is_oracle(config.utility.name) &&
                   needs_of(config.utility).shadow) {}

}  // namespace gnbv
