// A view looked at ray by ray, scalar and slow: what evaluate_view() does not count.
#pragma once

#include <vector>

#include "planner/view/visibility.hpp"

namespace gnbv {

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
