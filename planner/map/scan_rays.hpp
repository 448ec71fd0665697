// The beams of a sweep and the pixels of a depth frame as rays in the world. The rules (maximum
// range of a frame a plane, of a sweep a sphere; minimum range; floor) are the released code's; see
// FIDELITY.md.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "planner/map/map_kernels.hpp"
#include "sensors/camera_model.hpp"
#include "sensors/frames.hpp"
#include "sensors/lidar_model.hpp"

namespace gnbv {

/// A ray, float32 as OctoMap's clouds. It clears the voxels from the sensor up to, not including,
/// the one with `end`; `hit` says that this one holds a surface.
struct ScanRay {
  Vec3f end_world_m = Vec3f::Zero();
  bool hit = false;
};

/// Rays of a sweep in beam order, without those of beams that say nothing.
std::vector<ScanRay> rays_of(const LidarScan& scan, const LidarModel& lidar, double floor_z_m,
                             NoReturn no_return = NoReturn::free);

/// The ends of the rays that hit: the points of the cloud.
std::vector<Vec3f> surface_points_world_m(std::span<const ScanRay> rays);

/// A ray a pixel, row-major, in columns for the vector loops. Ends of pixels that say nothing are
/// unspecified.
struct FrameRays {
  Vec3f origin_world_m = Vec3f::Zero();
  std::array<std::vector<float>, 3> end_m;  // x, y and z, world
  std::vector<PixelRay> kind;
  std::vector<float> inverse_depth;  // (height, row_stride), see PixelRow; padded with infinity
  int row_stride = 0;

  Vec3f end_world_m(std::size_t i) const { return {end_m[0][i], end_m[1][i], end_m[2][i]}; }
  /// Those from pixel `first` on.
  EndRow row(std::size_t first) const {
    return {{end_m[0].data() + first, end_m[1].data() + first, end_m[2].data() + first},
            kind.data() + first};
  }
};

/// Fills `rays`, reusing its memory.
void compute_frame_rays(const DepthFrame& frame, const CameraModel& camera, double floor_z_m,
                        FrameRays& rays, NoReturn no_return = NoReturn::free);
/// The same of rays_of(), without depths: for those who go ray by ray.
void compute_sweep_rays(const LidarScan& scan, const LidarModel& lidar, double floor_z_m,
                        FrameRays& rays, NoReturn no_return = NoReturn::free);

}  // namespace gnbv
