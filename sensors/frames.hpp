// What the sensors hand to the map: ranges with the pose the measurement was taken from.
#pragma once

#include <limits>
#include <vector>

#include "sim/core/pose.hpp"

namespace gnbv {

/// A return nearer than the minimum range: says nothing about the space before it.
constexpr float kInvalidRange = std::numeric_limits<float>::quiet_NaN();
/// No return within the maximum range: the space up to the maximum range is free.
constexpr float kNoReturn = std::numeric_limits<float>::infinity();

struct DepthFrame {
  int camera = 0;                                  // index of the camera on the vehicle
  Isometry T_world_camera = Isometry::Identity();  // optical frame
  std::vector<float> depth_m;  // (height, width) row-major, along the optical axis; see above
};

struct LidarScan {
  Isometry T_world_lidar = Isometry::Identity();
  std::vector<float> range_m;  // (beams), along the beam; see above
};

}  // namespace gnbv
