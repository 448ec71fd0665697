// Two slips of the released code, kept behind switches so that their effect on the paper's tables
// can be measured. Scalar and slow: nothing else uses it.
#pragma once

#include "planner/map/occupancy_grid.hpp"
#include "planner/map/surface_cloud.hpp"
#include "planner/view/view_rays.hpp"
#include "planner/view/view_stats.hpp"

namespace gnbv {

struct ReleasedSlips {
  /// The voxels of a ray that hits something are listed towards the centre of the voxel it hit and
  /// without that voxel: occupied voxels count only where the list clips them on the way. A flat
  /// wall seen head-on shows none.
  bool excludes_hit_voxel = false;
  /// A ray that hits a surface counts the voxel it hit only when a ray cast among the predicted
  /// voxels hits one too, at any distance within range.
  bool prediction_hides_hits = false;

  bool any() const { return excludes_hit_voxel || prediction_hides_hits; }
};

/// What evaluate_view() gives with the slips.
ViewStats evaluate_view_with_slips(const OccupancyGrid& grid, const SurfaceCloud& cloud,
                                   const ViewRays& rays, const ViewPose& candidate,
                                   const ReleasedSlips& slips, double sparse_below);

}  // namespace gnbv
