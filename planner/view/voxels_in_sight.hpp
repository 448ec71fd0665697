// Which voxels a view is worth its way for, one by one: evaluate_view() only counts them.
#pragma once

#include <vector>

#include "planner/map/occupancy_grid.hpp"
#include "planner/view/view_rays.hpp"

namespace gnbv {

/// Ascending, each once.
struct VoxelsInSight {
  std::vector<VoxelIndex> unknown;    // that the rays cross before they meet an occupied one
  std::vector<VoxelIndex> predicted;  // the first predicted one of each ray: Eq. (3)'s N_pred
};

/// Of a view from that pose: those of ViewStats::unknown_voxels and predicted_voxels (without the
/// released slips), but for near ties. Slower, and it needs no memory of its own. `rays` must have
/// been made for the grid's resolution.
VoxelsInSight voxels_in_sight(const OccupancyGrid& grid, const ViewRays& rays,
                              const ViewPose& view);

}  // namespace gnbv
