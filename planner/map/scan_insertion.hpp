// From scans to the voxels that they touch. The rules (planar maximum range, floor, minimum range,
// one update a voxel and scan, occupied wins) are the released code's; see FIDELITY.md.
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

/// Computes updates. Its memory, a byte a voxel and one more for each thread, serves all scans.
class ScanInserter {
 public:
  explicit ScanInserter(const GridGeometry& grid) : grid_(grid), frames_(grid) {}

  /// The update of `map` by a frame: the voxels that it touches, each list in ascending order. Free
  /// voxels may be missing if a miss changes nothing of them now, so that the update has to be the
  /// next one that is applied. `rays` is compute_frame_rays() of the frame. Works voxel by voxel
  /// where can_project() allows it and the pixels are many, else ray by ray on one thread, and
  /// gives the same map.
  ScanUpdate compute_update(const FrameRays& rays, const DepthFrame& frame,
                            const CameraModel& camera, const OccupancyGrid& map, int threads);

  /// Inserts the sweeps of a profile, each one update, in their order. LidarScan::lidar says which
  /// of `lidars` took a sweep.
  void insert_scans(OccupancyGrid& grid, std::span<const LidarScan> scans,
                    std::span<const LidarModel> lidars, double floor_z_m, int threads);

 private:
  void need_walkers(int threads);

  GridGeometry grid_;
  FrameInserter frames_;
  std::vector<FanWalker> walkers_;  // one a thread
};

}  // namespace gnbv
