// One measurement of one sensor, ray-traced.
#pragma once

#include <cstdint>
#include <span>

#include "sensors/camera_model.hpp"
#include "sensors/frames.hpp"
#include "sensors/lidar_model.hpp"
#include "sensors/ray_scene.hpp"

namespace gnbv {

/// What the noise of a measurement is keyed by, beside the sensor and the pixel or beam: the seed
/// of the mission and the tick of the measurement. Noise depends on nothing else.
struct NoiseKey {
  std::uint64_t seed = 0;
  std::uint64_t tick = 0;
};

/// Depth along the optical axis for every pixel centre: kInvalidRange nearer than range_min_m,
/// kNoReturn beyond range_max_m, noise by CameraConfig::noise before either is decided. The frame
/// is the same at any number of threads. `T_world_body` is the true pose, and the frame carries it:
/// who believes another one says so afterwards.
DepthFrame capture_depth(const RayScene& scene, const CameraModel& camera, int camera_index,
                         const Isometry& T_world_body, const NoiseKey& key, int threads);

/// What the camera sees in colour: materials under a sun with shadows and a sky, sRGB, each pixel
/// the colour of what its depth was measured from (no anti-aliasing: aligned pixel by pixel).
ColourFrame capture_colour(const RayScene& scene, const CameraModel& camera, int camera_index,
                           const Isometry& T_world_body, int threads);

/// One sweep of the LIDAR. `T_world_body_during` are true poses evenly spread over
/// sweep_duration_s(), first and last included; one pose means a sweep at one instant. Each beam is
/// traced from the pose of its own time, in between interpolated; the scan carries the first pose,
/// as a driver stamps it, so that a moving rolling scan is skewed.
LidarScan capture_scan(const RayScene& scene, const LidarConfig& lidar, int lidar_index,
                       std::span<const Isometry> T_world_body_during, const NoiseKey& key);

}  // namespace gnbv
