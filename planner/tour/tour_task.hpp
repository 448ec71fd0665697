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
  double reality = 1.0;               // what looks brought lately, of what they promised
  std::span<const ViewPose> refused;  // that no tour may hold now
  std::span<const TourView> tour;     // that a tour has to be able to hold
};

struct TourTask {
  PrizeTask prizes;
  std::vector<TourView> views;  // of the task, in its order
};

/// Small voxels that the surface is expected to fill, those that hold a point included.
double expected_voxels(const SurfaceCells& cells);

/// Small voxels that one look at each patch that any view sees can be expected to bring.
double voxels_in_reach(const TourKnowledge& knowledge);

/// Of each patch, whether a view from any reachable place sees it.
std::vector<std::uint8_t> seen_from_anywhere(const TourKnowledge& knowledge);

/// All views of reachable places that may pay at `price_factor` times the configured price a metre.
/// Of more patches than config.items_max, one in so many stands for its share. Its `row_m` is left
/// to the caller.
TourTask make_tour_task(const TourKnowledge& knowledge, double price_factor);

}  // namespace gnbv
