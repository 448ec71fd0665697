// One measurement of one sensor, ray-traced.
#pragma once

#include <span>

#include "sensors/camera_model.hpp"
#include "sensors/depth_noise.hpp"
#include "sensors/frames.hpp"
#include "sensors/lidar_model.hpp"
#include "sensors/ray_scene.hpp"

namespace gnbv {

/// Depth along the optical axis for every pixel centre, with the noise of CameraConfig::noise:
/// kInvalidRange when the surface or its reading is nearer than range_min_m, or the surface is too
/// grazing to return anything; kNoReturn when there is no surface, or its reading is beyond
/// range_max_m. The frame is the same at any number of threads. `T_world_body` is the true pose,
/// and the frame carries it: who believes another one says so afterwards.
DepthFrame capture_depth(const RayScene& scene, const CameraModel& camera, int camera_index,
                         const Isometry& T_world_body, const NoiseKey& key, int threads);

/// What the camera sees in colour: materials under a sun with shadows and a sky
/// (sensors/light.hpp), sRGB. Each pixel is the colour of what its centre looks at, at any
/// distance: aligned pixel by pixel with a depth that has no lateral noise, and not anti-aliased.
ColourFrame capture_colour(const RayScene& scene, const CameraModel& camera, int camera_index,
                           const Isometry& T_world_body, int threads);

/// One sweep of the LIDAR. `T_world_body_during` are true poses, one every `interval_s` from the
/// first beam to the last one or just after it; one pose means a sweep at one instant. Each beam is
/// traced from the pose of its own time, in between interpolated; the scan carries the first pose,
/// as a driver stamps it, so that a moving rolling scan is skewed. Ranges as depths above.
LidarScan capture_scan(const RayScene& scene, const LidarModel& lidar, int lidar_index,
                       std::span<const Isometry> T_world_body_during, double interval_s,
                       const NoiseKey& key);

}  // namespace gnbv
