// The unmeasured voxels just behind what was seen of the surface, where more of it is likely
// (proximity count and area factor: Delmerico et al. 2018; Vasquez-Gomez et al. 2014).
#pragma once

#include <cstdint>

#include "planner/map/occupancy_grid.hpp"
#include "planner/map/scan_rays.hpp"

namespace gnbv {

/// Depth of the shadow band behind a hit, along its ray. Default: the launch file of the released
/// code of Delmerico et al.
struct ShadowConfig {
  double shadow_depth_m = 0.3;
};

/// The depth is at most this: a ray of such a length takes fewer than 256 steps along three axes.
constexpr double kMaxShadow_voxels = 80.0;

/// For each unmeasured voxel behind a hit, the number of steps from the voxel of the hit along its
/// ray, the smallest of all rays; at least 1. The grid knows which voxels these are (is_shaded).
class ShadowBand {
 public:
  /// Throws BadInput naming shadow_depth_m when it is not between 0 and 80 voxels.
  ShadowBand(const ShadowConfig& config, const GridGeometry& grid);

  /// Adds the voxels behind the hits of a frame. The grid must hold the frame already.
  void add(const FrameRays& rays, OccupancyGrid& grid);

  /// Adds a voxel of a band that was saved. False, and nothing changes, when it is measured or
  /// `steps` is below 1.
  bool restore(VoxelIndex v, int steps, OccupancyGrid& grid);

  /// Steps behind the surface; 0 for a voxel in no shadow. Holds while grid.is_shaded(v).
  int steps_behind(VoxelIndex v) const { return steps_[v]; }
  /// The same of all voxels, and a vector of zeros.
  const std::uint8_t* steps() const { return steps_.data(); }
  /// delta_max of the proximity count: 2 depth / resolution.
  double steps_max() const { return steps_max_; }

 private:
  double shadow_depth_m_;
  double steps_max_;
  ZeroedArray<std::uint8_t> steps_;
};

}  // namespace gnbv
