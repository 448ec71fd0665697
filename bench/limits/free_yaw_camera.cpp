#include "bench/limits/free_yaw_camera.hpp"

#include <algorithm>
#include <cmath>

namespace gnbv {
namespace {

/// Of what is in the image, from the camera.
double farthest_m(const CameraModel& camera) {
  if (camera.is_radial()) return return_end_m(camera.config);
  const Eigen::Vector2d tan = camera.sight.max().cwiseMax(-camera.sight.min());
  return return_end_m(camera.config) * std::sqrt(1.0 + tan.x() * tan.x() + tan.y() * tan.y());
}

}  // namespace

FreeYawCamera::FreeYawCamera(const CameraModel& camera)
    : camera_(camera),
      range_min_m_(camera.config.range_min_m),
      range_max_m_(return_end_m(camera.config)),
      reach_m_(farthest_m(camera) + camera.config.p_body_m.norm()) {
  const Vec3& p_body_m = camera.config.p_body_m;
  const Isometry T_camera_body = camera.T_body_camera.inverse();
  offset_camera_m_ = T_camera_body.translation();
  // seen by a tilted camera, bearings outside its field of view are in the image, too
  const double half_rad = std::max(camera.sight_rad.max().x(), -camera.sight_rad.min().x());
  const double last_share = camera.config.pitch_rad == 0.0 ? 1.0 : kPi / half_rad;
  const Vec3 aside = Eigen::AngleAxisd(camera.config.yaw_rad, Vec3::UnitZ()) * Vec3::UnitY();
  const bool is_symmetric =
      !camera.lens && camera.config.roll_rad == 0.0 && std::abs(aside.dot(p_body_m)) < 1e-9;
  for (const double share : {0.0, 0.5, 0.8, 0.99, 1.1, 1.25, 1.5, 2.0, 3.0, 4.0}) {
    if (share > last_share) break;
    for (const double side : {1.0, -1.0}) {
      if (side < 0.0 && (is_symmetric || share == 0.0)) continue;
      const double rad = camera.config.yaw_rad + side * share * half_rad;
      bearings_.push_back({T_camera_body.linear() * Vec3(std::cos(rad), std::sin(rad), 0.0),
                           T_camera_body.linear().col(2),
                           Eigen::AngleAxisd(-rad, Vec3::UnitZ()) * p_body_m});
    }
  }
}

std::optional<Vec3> FreeYawCamera::origin_world_m(const Vec3& vehicle_world_m,
                                                  const Vec3& point_world_m) const {
  const Vec3 to_m = point_world_m - vehicle_world_m;
  if (to_m.squaredNorm() > reach_m_ * reach_m_) return std::nullopt;
  const double level_m = to_m.head<2>().norm();
  for (const Bearing& bearing : bearings_) {
    const Vec3 p = level_m * bearing.per_level + to_m.z() * bearing.per_height + offset_camera_m_;
    const double range_m = camera_.range_of(p);
    if (range_m < range_min_m_ || range_m > range_max_m_ || !camera_.has_in_image(p)) continue;
    // the vehicle's turn by the point's bearing in the world; straight above, any turn will do
    const double cos = level_m > 0.0 ? to_m.x() / level_m : 1.0;
    const double sin = level_m > 0.0 ? to_m.y() / level_m : 0.0;
    const Vec3& q = bearing.p_turned_m;
    return vehicle_world_m + Vec3(cos * q.x() - sin * q.y(), sin * q.x() + cos * q.y(), q.z());
  }
  return std::nullopt;
}

}  // namespace gnbv
