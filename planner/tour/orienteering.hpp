// Open tours that trade what their views can be expected to bring against the way between them: an
// orienteering problem whose profits overlap.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "planner/tour/waypoints.hpp"

namespace gnbv {

/// An observation that finds the item with some probability, whatever others do.
struct ItemObservation {
  std::uint32_t item = 0;
  float success = 0.0F;
};

/// Views at the nodes of a roadmap, what they may bring, and the way between the nodes.
struct OrienteeringProblem {
  std::vector<float> weight;                               // of each item
  std::vector<std::vector<ItemObservation>> observations;  // of each view, by ascending item
  std::vector<std::uint32_t> node;                         // of each view
  std::uint32_t start = 0;                                 // the node where a tour begins
  double cost_per_m = 0.0;                                 // of way, in weight
  double metres_per_view = 0.0;                            // what a view costs as if it were way
  RowOf row_m = {};                                        // asked again and again
};

struct OrienteeringTour {
  std::vector<std::uint32_t> nodes;  // in the order of the tour, each once, the start first
  std::vector<std::uint32_t> views;  // in the order of the nodes, at a node by number
  double length_m = 0.0;
  double found = 0.0;  // weight that can be expected
  double worth = 0.0;  // found less what it costs
};

/// How long a search goes on, and which random numbers it takes.
struct TourSearch {
  int iterations = 0;  // 0: greedily, view by view
  std::uint64_t seed = 0;
  std::function<void()> heed_stop = {};  // called now and then; may throw
};

/// The tour with the greatest worth that a large-neighbourhood search met (Shaw 1998; Ropke,
/// Pisinger 2006), begun with `from`: takes 2 to 15 views out - some in a row, the nearest of one,
/// or any - puts others in by what they bring per metre of detour and a random price of a view,
/// drops those that do not pay, and accepts as annealing does, from 0.6 m of loss down to 0.01 m.
/// Deterministic.
OrienteeringTour solve(const OrienteeringProblem& problem, std::span<const std::uint32_t> from,
                       const TourSearch& search);

}  // namespace gnbv
