// Whether the LIDARs see a point of the surface while the profile is flown.
#pragma once

#include <vector>

#include "scenarios/scenario.hpp"
#include "sensors/ray_scene.hpp"

namespace gnbv {

/// The fan of a LIDAR sweeps space as the vehicle moves along a leg. Of rings and rosettes all
/// counts that lies in their field of view from places half a metre apart. The vehicle is level, or
/// leans by a few degrees as it does in flight. Const after construction.
class LidarSight {
 public:
  /// The legs of the scenario's profile from its start without jitter, so that all seeds have one
  /// ceiling: none without a profile; of a saved one those of the bounding box, of an adaptive one
  /// those of the tallest structure. Keeps the reference.
  LidarSight(const Scenario& scenario, const RayScene& scene);

  bool is_seen(const Vec3f& point_world_m) const;

 private:
  /// One straight leg with one LIDAR at one lean of the vehicle.
  struct Sweep {
    Vec3 from_m = Vec3::Zero();  // of the LIDAR
    Vec3 along_m = Vec3::Zero();
    Eigen::Matrix3d R_lidar_world = Eigen::Matrix3d::Identity();
    double range_min_m = 0.0, range_max_m = 0.0, half_fov_rad = 0.0;
    LidarConfig lidar = {};
  };
  /// From where on the leg the LIDAR has the point in its field of view, in range or not.
  static std::vector<Vec3> origins_m(const Sweep& sweep, const Vec3& point_world_m);

  const RayScene& scene_;
  std::vector<Sweep> sweeps_;
};

}  // namespace gnbv
