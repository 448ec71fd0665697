// From what is believed to the orienteering problem whose solution is the tour.
#pragma once

#include <vector>

#include "planner/tour/orienteering.hpp"
#include "planner/tour/tour_state.hpp"

namespace gnbv {

struct TourProblem {
  OrienteeringProblem problem;
  std::vector<TourView> views;  // of the problem, in its order
};

/// All surface that is believed to be there, seen or not.
struct ExpectedSurface {
  double voxels = 0.0;  // small ones, those that hold a point included
  Box3 box_m;           // around their cells; empty without any
  /// Of a tour twice as long as the box's sides together, which is what tours come to: 144 m for
  /// the paper's aircraft, flown in 140 to 160 m. The same for a model of it on any scale.
  double voxels_a_metre() const;
};
ExpectedSurface expected_surface(const SurfaceCells& cells);

/// Of each patch, whether a view from any reachable node sees it.
std::vector<std::uint8_t> seen_from_anywhere(const TourState& state);

/// Small voxels that one observation of each patch that any view sees can be expected to bring.
double voxels_in_reach(const TourState& state);

/// All views of reachable nodes that may pay when a metre has to bring `cost_per_m` small voxels.
/// Of more than 12,000 patches one in so many stands for its share. Its `row_m` is left to the
/// caller.
TourProblem make_tour_problem(const TourConfig& config, const TourState& state, double cost_per_m);

}  // namespace gnbv
