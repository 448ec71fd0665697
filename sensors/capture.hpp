// One measurement of one sensor, ray-traced.
#pragma once

#include <span>

#include "sensors/camera_model.hpp"
#include "sensors/depth_noise.hpp"
#include "sensors/frames.hpp"
#include "sensors/lidar_model.hpp"
#include "sensors/ray_scene.hpp"

namespace gnbv {

/// Depth along the optical axis for every pixel centre, with the noise of CameraConfig::noise.
/// kInvalidRange: the surface or its reading is nearer than range_min_m, or too slanted to return
/// anything. kNoReturn: no surface, or a reading beyond return_end_m(). The same at any number of
/// threads. `T_world_body` is the true pose, which the frame carries.
DepthFrame capture_depth(const RayScene& scene, const CameraModel& camera, int camera_index,
                         const Isometry& T_world_body, const NoiseKey& key, int threads);

/// Colour for every pixel centre, at any distance, in sRGB: materials under a sun with shadows and
/// a sky. Pictures of meshes are interpolated between their pixels (colour_at()), not smoothed
/// where they are finer than the frame. Aligned with a depth frame that has no lateral noise; not
/// anti-aliased.
ColourFrame capture_colour(const RayScene& scene, const CameraModel& camera, int camera_index,
                           const Isometry& T_world_body, int threads);
/// Unit vector to its sun, in the south-west, 50 degrees high.
Vec3f towards_sun_world();

/// One sweep of the LIDAR; ranges as depths above. `T_world_body_during` are true poses, one every
/// `interval_s` from the first beam to the last one or just after it; one pose means a sweep at one
/// instant. Each beam is traced from the interpolated pose of its own time. The scan carries the
/// first pose, as a driver stamps it: a scan in motion is skewed. `begin_s`: when it begins, for a
/// rosette.
LidarScan capture_scan(const RayScene& scene, const LidarModel& lidar, int lidar_index,
                       std::span<const Isometry> T_world_body_during, double interval_s,
                       const NoiseKey& key, double begin_s = 0.0);

}  // namespace gnbv
