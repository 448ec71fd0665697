// Open tours that trade what their views can be expected to bring against the way between them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planner/tour/stops.hpp"

namespace gnbv {

/// A look that finds the item with some probability, whatever other looks do.
struct ItemLook {
  std::uint32_t item = 0;
  float success = 0.0F;
};

/// Views at places, what they may bring, and the way between the places.
struct PrizeTask {
  std::vector<float> weight;                 // of each item
  std::vector<std::vector<ItemLook>> looks;  // of each view, items in ascending order
  std::vector<std::uint32_t> place;          // of each view
  std::uint32_t start = 0;                   // the place where a tour begins
  double price_per_m = 0.0;                  // of way, in weight
  double metres_per_view = 0.0;              // what a view costs as if it were way
  RowOf row_m = {};                          // asked again and again
};

struct PrizeTour {
  std::vector<std::uint32_t> places;  // in the order of the tour, each once, the start first
  std::vector<std::uint32_t> views;   // in the order of the places, at a place by number
  double length_m = 0.0;
  double found = 0.0;  // weight that can be expected
  double worth = 0.0;  // found less what it costs
};

/// The tour with the greatest worth that a large-neighbourhood search met (Shaw 1998; Ropke,
/// Pisinger 2006), begun with `from`: takes 2 to 15 views out - some in a row, the nearest of one,
/// or any - puts others in by what they bring per metre of detour and a random price of a view,
/// drops those that do not pay, and accepts as annealing does, from 0.6 m of loss down to 0.01 m.
/// Without iterations: greedily, view by view. Deterministic.
PrizeTour search_prize_tour(const PrizeTask& task, std::span<const std::uint32_t> from,
                            int iterations, std::uint64_t seed);

}  // namespace gnbv
