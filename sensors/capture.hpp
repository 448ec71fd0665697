// One measurement of one sensor, ray-traced.
#pragma once

#include "sensors/camera_model.hpp"
#include "sensors/frames.hpp"
#include "sensors/lidar_model.hpp"
#include "sensors/ray_scene.hpp"

namespace gnbv {

/// Depth along the optical axis for every pixel centre: kInvalidRange nearer than range_min_m,
/// kNoReturn beyond range_max_m. The frame is the same at any number of threads.
DepthFrame capture_depth(const RayScene& scene, const CameraModel& camera, int camera_index,
                         const Isometry& T_world_body, int threads);

/// One sweep of the LIDAR, taken at one instant.
LidarScan capture_scan(const RayScene& scene, const LidarConfig& lidar,
                       const Isometry& T_world_body);

}  // namespace gnbv
