// The pixels of a depth frame as rays in the world, in columns for the vector loops.
#pragma once

#include <vector>

#include "planner/map/frame_kernels.hpp"
#include "sensors/camera_model.hpp"
#include "sensors/frames.hpp"

namespace gnbv {

/// One entry a pixel, row-major. The bits of each end are those of ScanRay::end_world_m from
/// rays_of(); entries of pixels that say nothing are unspecified.
struct FrameRays {
  Vec3f origin_world_m = Vec3f::Zero();
  std::vector<float> x_m, y_m, z_m;  // ends, world
  std::vector<PixelRay> kind;
};

/// Fills `rays`, reusing its memory.
void compute_frame_rays(const DepthFrame& frame, const CameraModel& camera, double floor_z_m,
                        FrameRays& rays);

}  // namespace gnbv
