#include "planner/core/model.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gnbv {
namespace {

/// Volume of the pyramids up to maximum range, in voxels.
double frustum_voxels(std::span<const CameraModel> cameras, double resolution_m) {
  double volume_m3 = 0.0;
  for (const CameraModel& camera : cameras) volume_m3 += frustum_m3(camera.config);
  return volume_m3 / std::pow(resolution_m, 3);
}

std::vector<ViewRays> rays_by_pitch(std::span<const CameraModel> cameras,
                                    std::span<const double> pitches_rad, double resolution_m) {
  std::vector<ViewRays> rays;
  for (const double pitch_rad : pitches_rad) {
    rays.push_back(make_view_rays(turned(cameras, pitch_rad), resolution_m));
  }
  return rays;
}

}  // namespace

PlannerModel::PlannerModel(const BeliefConfig& belief_config, const ValidityConfig& validity_config,
                           const Box3& workspace, std::span<const CameraModel> camera_models,
                           std::span<const LidarModel> lidar_models, std::uint64_t mission_seed,
                           NoFly mission_no_fly)
    : belief(belief_config),
      validity(validity_config),
      seed(mission_seed),
      workspace_m(workspace),
      navigation_m(navigation_box_m(validity_config, workspace)),
      no_fly(std::move(mission_no_fly)),
      cameras(camera_models.begin(), camera_models.end()),
      lidars(lidar_models.begin(), lidar_models.end()),
      gimbal(gimbal_of(cameras)),
      pitches_rad(gimbal ? gnbv::pitches_rad(*gimbal) : std::vector<double>{0.0}),
      view_rays(rays_by_pitch(cameras, pitches_rad, belief.map.resolution_m)),
      view_voxels(frustum_voxels(cameras, belief.map.resolution_m)) {}

const ViewRays& PlannerModel::rays_at(double gimbal_pitch_rad) const {
  const auto nearest =
      std::min_element(pitches_rad.begin(), pitches_rad.end(), [&](double a, double b) {
        return std::abs(a - gimbal_pitch_rad) < std::abs(b - gimbal_pitch_rad);
      });
  return view_rays[static_cast<std::size_t>(nearest - pitches_rad.begin())];
}

bool PlannerModel::can_pitch(double gimbal_pitch_rad) const {
  constexpr double kRounding_rad = 1e-9;
  if (!gimbal) return gimbal_pitch_rad == 0.0;
  return gimbal_pitch_rad >= gimbal->min_rad - kRounding_rad &&
         gimbal_pitch_rad <= gimbal->max_rad + kRounding_rad;
}

}  // namespace gnbv
