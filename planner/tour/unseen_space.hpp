// Where a look at unknown space is worth its way.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "planner/core/belief.hpp"
#include "planner/tour/tour_state.hpp"

namespace gnbv {

/// A little more than the convex hull of the surface: between its outermost cells along 25 axes.
class SurfaceHull {
 public:
  explicit SurfaceHull(const SurfaceCells& cells);
  /// How far a point lies beyond the axis along which it is furthest out; within: 0 or less. No
  /// more than its distance from the hull.
  double off_m(const Vec3& p_world_m) const;

 private:
  std::vector<Vec3> axes_;
  std::vector<double> furthest_m_;  // along each of them
};

/// Where to look when nothing is known to be missing: of the views that which sees the most unknown
/// voxels per metre of its way, the first of equals; `way_m`: to each. Nothing when none sees a
/// fiftieth of what the cameras' frusta hold. `within` a hull only its voxels count, and a tenth is
/// the least: at the rims of a hull some space is always unseen. The same at any number of threads.
std::optional<std::size_t> most_unseen(const PlannerModel& model, const Belief& belief,
                                       std::span<const TourView> views,
                                       std::span<const double> way_m, Scratch& scratch,
                                       const SurfaceHull* within = nullptr);

}  // namespace gnbv
