// From frames to the voxels they touch. The rules (planar maximum range, floor, minimum range, one
// update a voxel and scan, occupied wins) are the released code's; see FIDELITY.md.
#pragma once

#include <span>
#include <vector>

#include "planner/map/occupancy_grid.hpp"
#include "sensors/camera_model.hpp"
#include "sensors/frames.hpp"
#include "sensors/lidar_model.hpp"

namespace gnbv {

/// One ray of a scan in world coordinates, float32 as OctoMap's clouds. It clears the voxels from
/// the sensor up to, not including, the one with `end`; `hit` says that one holds a surface.
struct ScanRay {
  Vec3f end_world_m = Vec3f::Zero();
  bool hit = false;
};

/// Rays of a depth frame in row-major pixel order: kInvalidRange gives no ray, kNoReturn a clearing
/// ray to the plane at range_max_m, a return below `floor_z_m` clears but marks nothing.
std::vector<ScanRay> rays_of(const DepthFrame& frame, const CameraModel& camera, double floor_z_m);

/// Rays of a sweep in beam order; the maximum range is a sphere.
std::vector<ScanRay> rays_of(const LidarScan& scan, const LidarConfig& lidar, double floor_z_m);

/// The voxels the rays touch inside the grid. Oracle: octomap::OcTree::computeUpdate.
/// Rays are walked in bands on `threads` threads; the result, order included, does not depend on it.
ScanUpdate compute_update(const GridGeometry& grid, const Vec3f& origin_world_m,
                          std::span<const ScanRay> rays, int threads);

/// Batch insertion of the buffered profile: each sweep is one update, in order of time.
void insert_scans(OccupancyGrid& grid, std::span<const LidarScan> scans, const LidarConfig& lidar,
                  double floor_z_m, int threads);

}  // namespace gnbv
