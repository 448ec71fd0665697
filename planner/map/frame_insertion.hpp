// Puts a depth frame into the map voxel by voxel instead of ray by ray: the rays of a frame take
// millions of steps, but cross some ten thousand voxels. The answer is OctoMap's. A voxel is freed
// when some ray passes it and ends beyond it by more than a margin, which is far above the rounding
// of OctoMap's float32 rays. It stays untouched when every ray misses it, or ends before it, by the
// margin. The few rays in between are walked as OctoMap walks them.
#pragma once

#include <cstdint>
#include <vector>

#include "planner/map/occupancy_grid.hpp"
#include "planner/map/scan_rays.hpp"

namespace gnbv {

/// Whether voxels can be projected into the frame. Not when the camera is outside the grid, its
/// rotation is none, its minimum range is not positive, its rays end beyond OctoMap's keys, the
/// voxels are narrow against the margin, or float32 cannot count the pixels.
bool can_project(const GridGeometry& grid, const DepthFrame& frame, const CameraModel& camera);

/// Computes updates of frames. Its memory serves one frame after the other: a byte a voxel, and for
/// each thread a byte and an integer a pixel.
class FrameInserter {
 public:
  explicit FrameInserter(const GridGeometry& grid);

  /// The voxels of `map` that the frame's rays touch, in ascending order, the same on any number of
  /// threads. Free voxels that are settled (OccupancyGrid::settled_word()) may be missing: a miss
  /// changes nothing of them. `rays` is compute_frame_rays() of the frame. Requires can_project().
  /// Oracle: octomap::OcTree::computeUpdate.
  ScanUpdate compute_update(const FrameRays& rays, const DepthFrame& frame,
                            const CameraModel& camera, const OccupancyGrid& map, int threads);

  /// How many single rays were walked for the last frame. Those that two threads asked for count
  /// twice.
  std::size_t walked_count() const { return walked_count_; }

 private:
  struct Worker {
    std::vector<std::uint8_t> walk;    // (pixels)
    std::vector<std::int32_t> doubts;  // (pixels + padding)
    std::vector<std::int32_t> ends;    // (width + padding)
  };
  void read_band(const FrameView& view, const FrameRays& rays, int band, Worker& worker);
  void walk_doubtful_rays(const FrameRays& rays);
  ScanUpdate collect(const FrameView& view);

  GridGeometry grid_;
  ZeroedArray<std::uint8_t> marks_;            // of voxels; untouched between calls
  std::vector<float> tile_windows_;            // (levels, tile rows, tile_stride)
  std::vector<std::vector<VoxelIndex>> ends_;  // of each band of kTile_px rows
  std::vector<Worker> workers_;
  std::size_t walked_count_ = 0;
};

}  // namespace gnbv
