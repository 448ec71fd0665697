// From what is believed to the question that the search answers.
#pragma once

#include <vector>

#include "planner/tour/catalogue.hpp"
#include "planner/tour/prize_tour.hpp"
#include "planner/tour/success.hpp"

namespace gnbv {

/// A view that a tour may hold.
struct TourView {
  TourPlaces::Place place = TourPlaces::kNone;
  ViewPose pose;
};

/// What a tour is made of, and by what it is weighed.
struct TourKnowledge {
  const TourConfig& config;
  const SurfaceCells& cells;
  std::span<const Patch> patches;
  const ViewCatalogue& catalogue;
  const TourPlaces& places;
  const LookSuccess& success;
  std::span<const ViewPose> refused;  // that no tour may hold now
  std::span<const TourView> tour;     // that a tour has to be able to hold
};

struct TourTask {
  PrizeTask prizes;
  std::vector<TourView> views;  // of the task, in its order
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

/// Small voxels that one look at each patch that any view sees can be expected to bring.
double voxels_in_reach(const TourKnowledge& knowledge);

/// Of each patch, whether a view from any reachable place sees it.
std::vector<std::uint8_t> seen_from_anywhere(const TourKnowledge& knowledge);

/// All views of reachable places that may pay when a metre has to bring `price_per_m` small voxels.
/// Of more patches than config.items_max, one in so many stands for its share. Its `row_m` is left
/// to the caller.
TourTask make_tour_task(const TourKnowledge& knowledge, double price_per_m);

}  // namespace gnbv
