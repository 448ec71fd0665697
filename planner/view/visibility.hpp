// What a candidate view would see: one walk of its rays.
#pragma once

#include <cstdint>
#include <vector>

#include "planner/map/occupancy_grid.hpp"
#include "planner/map/surface_cloud.hpp"
#include "planner/view/ray_by_ray.hpp"
#include "planner/view/shadow_band.hpp"
#include "planner/view/view_rays.hpp"
#include "planner/view/view_stats.hpp"

namespace gnbv {

/// Memory of one thread, about a byte a voxel, for one view after the other. No result depends on
/// what it holds.
struct VisitMarks {
  explicit VisitMarks(std::size_t voxels);

  ZeroedArray<std::uint8_t> marks;           // voxels the view at hand has seen; zero between views
  std::vector<std::int32_t> predicted_ends;  // first predicted voxel of each ray
  std::vector<std::int32_t> occupied;        // seen
};

/// What is counted of a view, and how.
struct ViewOptions {
  ViewDetail detail = ViewDetail::voxels;
  bool legacy_visibility = false;      // P_v multiplies P_j: released code of Delmerico et al.
  double sparse_below = 0.0;           // density below which a voxel counts as sparse
  const ShadowBand* shadow = nullptr;  // without one, proximity_sum is 0
  ReleasedSlips slips = {};            // with one, the detail is voxels
};

/// Walks all rays of a view from the candidate pose; density_max and path_m stay 0. `rays` must
/// have been made for the grid's resolution, `marks` for its number of voxels. Every SimdLevel
/// gives the same bits. The voxels are those of walk_ray_inside(), but for near ties: at 40 steps a
/// ray, 2 in a million.
ViewStats evaluate_view(const OccupancyGrid& grid, const SurfaceCloud& cloud, const ViewRays& rays,
                        const ViewPose& candidate, VisitMarks& marks,
                        const ViewOptions& options = {});

}  // namespace gnbv
