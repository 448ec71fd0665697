// A camera on a level vehicle that may turn as it likes.
#pragma once

#include <optional>
#include <vector>

#include "sensors/camera_model.hpp"

namespace gnbv {

/// Where a camera on a level vehicle that turns freely has to have a point for it to be in the
/// image, its gimbal, if it has one, at rest: a set of bearings is tried, from the image's middle
/// column to its edges, since the middle reaches the steepest rows and the edges, with depth
/// measured along the optical axis, the farthest.
class FreeYawCamera {
 public:
  explicit FreeYawCamera(const CameraModel& camera);

  /// No point farther from the vehicle's position is in the image.
  double reach_m() const { return reach_m_; }

  /// Where the camera is when it has the point within its image and range, at the first yaw tried
  /// that does it; nothing when none does. Nothing is said about what is in between.
  std::optional<Vec3> origin_world_m(const Vec3& vehicle_world_m, const Vec3& point_world_m) const;

 private:
  /// Of the point, from the body's x axis. The point's place in the optical frame is linear in its
  /// level distance and its height.
  struct Bearing {
    Vec3 per_level = Vec3::Zero();
    Vec3 per_height = Vec3::Zero();
    Vec3 p_turned_m = Vec3::Zero();  // the camera, on a vehicle that has a point at bearing 0 here
  };
  CameraModel camera_;
  double range_min_m_ = 0.0, range_max_m_ = 0.0, reach_m_ = 0.0;
  Vec3 offset_camera_m_ = Vec3::Zero();
  std::vector<Bearing> bearings_;
};

}  // namespace gnbv
