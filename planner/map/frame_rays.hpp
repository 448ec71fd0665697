// The pixels of a depth frame as rays in the world, in columns for the vector loops.
#pragma once

#include <cstdint>
#include <vector>

#include "sensors/camera_model.hpp"
#include "sensors/frames.hpp"

namespace gnbv {

/// What a pixel says. The rules are the released code's, see FIDELITY.md.
enum class PixelRay : std::uint8_t {
  none = 0,    // kInvalidRange, or nearer than range_min_m: says nothing
  clears = 1,  // no return, or beyond range_max_m (a plane), or below the floor: free up to the end
  hits = 2     // free up to the end, which is surface
};

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
