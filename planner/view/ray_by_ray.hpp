// A view looked at ray by ray, scalar and slow: what evaluate_view() does not count.
#pragma once

#include <vector>

#include "planner/map/occupancy_grid.hpp"
#include "planner/map/surface_cloud.hpp"
#include "planner/view/view_rays.hpp"
#include "planner/view/view_stats.hpp"

namespace gnbv {

/// Two slips of the released code, kept behind switches so that their effect on the paper's tables
/// can be measured.
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

/// What evaluate_view() gives with the slips. `rays` must have been made for the grid's resolution.
ViewStats evaluate_view_with_slips(const OccupancyGrid& grid, const SurfaceCloud& cloud,
                                   const ViewRays& rays, const ViewPose& candidate,
                                   const ReleasedSlips& slips, double sparse_below);

/// Ascending, each once.
struct VoxelsInSight {
  std::vector<VoxelIndex> unknown;    // that the rays cross before they meet an occupied one
  std::vector<VoxelIndex> predicted;  // the first predicted one of each ray: Eq. (3)'s N_pred
};

/// Those that ViewStats::unknown_voxels and predicted_voxels count of a view from that pose
/// (without the released slips), but for near ties. `rays` must have been made for the grid's
/// resolution.
VoxelsInSight voxels_in_sight(const OccupancyGrid& grid, const ViewRays& rays,
                              const ViewPose& view);

}  // namespace gnbv
