// What the configured utility needs to know of a candidate view, and no more.
#pragma once

#include "planner/utility.hpp"

namespace gnbv {

/// Evaluates the view at the detail that the utility needs, with the released slips where the
/// configuration asks for them. `shadow` is read only by utilities that need it; `sparse_below` is
/// the density below which a voxel is a frontier. density_max and path_m stay 0.
ViewStats candidate_stats(const UtilityConfig& config, const OccupancyGrid& grid,
                          const SurfaceCloud& cloud, const ShadowBand& shadow, double sparse_below,
                          const ViewRays& rays, const ViewPose& candidate, VisitMarks& marks);

}  // namespace gnbv
