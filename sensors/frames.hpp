// What the sensors give to the map: measurements with the pose that they were taken from.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "sim/core/pose.hpp"

namespace gnbv {

/// Nearer than the minimum range: tells nothing about the space before it.
constexpr float kInvalidRange = std::numeric_limits<float>::quiet_NaN();
/// No return within the maximum range: the space up to there is free.
constexpr float kNoReturn = std::numeric_limits<float>::infinity();

struct DepthFrame {
  int camera = 0;                                  // index of the camera on the vehicle
  Isometry T_world_camera = Isometry::Identity();  // optical frame
  std::vector<float> depth_m;  // (height, width) row-major, along the optical axis; see above
};

/// The same camera in colour, aligned with its depth pixel by pixel.
struct ColourFrame {
  int camera = 0;
  Isometry T_world_camera = Isometry::Identity();  // optical frame
  std::vector<std::array<std::uint8_t, 3>> rgb;    // (height, width) row-major, sRGB
};

struct LidarScan {
  int lidar = 0;         // index of the LIDAR on the vehicle
  double begin_s = 0.0;  // which beams a rosette has
  Isometry T_world_lidar = Isometry::Identity();
  std::vector<float> range_m;  // (LidarModel::beams_at), along the beam; see above
};

}  // namespace gnbv
