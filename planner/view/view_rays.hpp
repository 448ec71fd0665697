// The rays along which a candidate view is looked at.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "sensors/camera_model.hpp"

namespace gnbv {

/// The rays of a view in the body frame, in columns: one per voxel of each camera's plane at
/// maximum range (released code: 47 x 34 for 60 x 45 degrees, 8 m and 0.2 m), in tiles of 4 x 4
/// neighbours, which end close to each other and fill a vector. Each camera's rays are padded to
/// full vectors.
struct ViewRays {
  struct Camera {
    Vec3 origin_body_m = Vec3::Zero();
    std::array<Vec3, 4> corners_body_m;  // ends of the outermost rays
    double pyramid_m3 = 0.0;             // volume that one ray stands for
    std::size_t first = 0;               // into the columns
    std::size_t count = 0;               // rays, without the padding
  };
  double resolution_m = 0.0;
  std::vector<Camera> cameras;
  std::array<std::vector<double>, 3> end_body_m;  // x, y, z

  /// Rays of all cameras, without the padding.
  std::size_t count() const;
};

/// The rays of all cameras through a map of this resolution.
ViewRays make_view_rays(std::span<const CameraModel> cameras, double resolution_m);

}  // namespace gnbv
