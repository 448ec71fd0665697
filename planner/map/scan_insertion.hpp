// From scans to the voxels that they touch: one update a voxel and scan, occupied wins (the
// released code's rules; see FIDELITY.md).
#pragma once

#include <span>
#include <vector>

#include "planner/map/frame_insertion.hpp"
#include "planner/map/ray_walk.hpp"

namespace gnbv {

/// Lists what the rays of a scan touch. Memory of one thread, reused from scan to scan: marks of
/// the voxels already listed, over the grid and a frame one voxel wide around it. A ray that
/// reaches the frame has left the grid, and since it is straight it never comes back.
class FanWalker {
 public:
  explicit FanWalker(const GridGeometry& grid);

  /// The voxels the rays touch inside the grid. Oracle: octomap::OcTree::computeUpdate, whose
  /// computeRayKeys names the free ones. Points must be finite. The lists go into the memory of
  /// `update`, whatever it holds.
  ScanUpdate compute_update(const Vec3f& origin_world_m, std::span<const ScanRay> rays,
                            ScanUpdate update = {});

 private:
  using Place = std::int32_t;  // a voxel's index in the framed grid

  VoxelIndex voxel_at(Place place) const;
  /// Appends the voxel to listed_ unless it is marked, and marks it.
  void list(const Key& key);
  /// Takes those listed from number `first` on, and their marks, away.
  void take(std::size_t first, std::vector<VoxelIndex>& voxels);
  /// Lists the ray's first voxel in the grid and puts the ray there into the bundle; false when it
  /// goes no further.
  bool start_ray(const RayOrigin& origin, const Vec3f& end_m, std::size_t which);

  GridGeometry grid_, framed_;
  std::array<Place, 3> move_;                 // change of place with a step up each axis
  double layers_per_place_, rows_per_place_;  // 1 over move_[2] and move_[1]
  std::size_t steps_max_;                     // of one ray inside the grid
  std::vector<std::uint8_t> marks_;           // of the framed grid, and one resting place
  std::vector<Place> listed_;                 // of the scan at hand, listed_count_ of them
  std::size_t listed_count_ = 0;
  FanRays bundle_{};
};

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
  /// Ray by ray, whatever they are the rays of.
  ScanUpdate compute_update(const FrameRays& rays);

  /// Inserts the sweeps of a profile, each one update, in their order. LidarScan::lidar says which
  /// of `lidars` took a sweep.
  void insert_scans(OccupancyGrid& grid, std::span<const LidarScan> scans,
                    std::span<const LidarModel> lidars, double floor_z_m, int threads);

 private:
  GridGeometry grid_;
  FrameInserter frames_;
  std::vector<FanWalker> walkers_;  // one a thread
};

}  // namespace gnbv
