// From frames to the voxels they touch. The rules (planar maximum range, floor, minimum range, one
// update a voxel and scan, occupied wins) are the released code's; see FIDELITY.md.
#pragma once

#include <span>
#include <vector>

#include "planner/map/fan_walker.hpp"
#include "planner/map/frame_insertion.hpp"
#include "planner/map/frame_rays.hpp"
#include "planner/map/occupancy_grid.hpp"
#include "sensors/camera_model.hpp"
#include "sensors/frames.hpp"
#include "sensors/lidar_model.hpp"

namespace gnbv {

/// Rays of a sweep in beam order; the maximum range is a sphere.
std::vector<ScanRay> rays_of(const LidarScan& scan, const LidarModel& lidar, double floor_z_m);

/// The ends of the rays that hit: the points of the cloud.
std::vector<Vec3f> surface_points_world_m(std::span<const ScanRay> rays);

/// Computes updates, reusing its memory from scan to scan: a byte a voxel and thread, and one.
class ScanInserter {
 public:
  explicit ScanInserter(const GridGeometry& grid) : grid_(grid), frames_(grid) {}

  /// What a frame makes of that map, to which it is applied before anything else is: the voxels it
  /// touches, each list in ascending order; free ones of which a miss changes nothing may be
  /// missing. `rays` is compute_frame_rays() of it. Voxel by voxel where can_project() allows it
  /// and the pixels are many, else ray by ray on one thread; the same map.
  ScanUpdate compute_update(const FrameRays& rays, const DepthFrame& frame,
                            const CameraModel& camera, const OccupancyGrid& map, int threads);

  /// Inserts the buffered profile: each sweep is one update, in order of time. LidarScan::lidar
  /// says which of `lidars` took it.
  void insert_scans(OccupancyGrid& grid, std::span<const LidarScan> scans,
                    std::span<const LidarModel> lidars, double floor_z_m, int threads);

 private:
  void need_walkers(int threads);

  GridGeometry grid_;
  FrameInserter frames_;
  std::vector<FanWalker> walkers_;  // one a thread
};

}  // namespace gnbv
