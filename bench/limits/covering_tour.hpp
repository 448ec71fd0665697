// Short open tours from whose views enough is seen: which views, and in which order.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/limits/cover_counts.hpp"
#include "planner/motion/config.hpp"
#include "planner/tour/waypoints.hpp"

namespace gnbv {

/// Views at places, and the way between those.
struct CoverTask {
  const CoverSets& views;                 // what each of them finds
  std::vector<std::uint32_t> place;       // of each view
  std::uint32_t start = 0;                // the place where a tour begins
  std::vector<std::uint32_t> given = {};  // found before the first view
  RowOf row_m;                            // asked again and again
  std::uint64_t seed = 0;                 // of what a search leaves to chance
  HeedStop stop = {};                     // called now and then; may throw
};

/// What a tour is to find, and what it costs: metres and metres_per_view for each view.
struct CoverAim {
  std::size_t wanted = 0;
  double metres_per_view = 0.0;
};

struct CoveringTour {
  std::vector<std::uint32_t> places;  // in the order of the tour, each once, the start first
  std::vector<std::uint32_t> views;   // ascending
  double length_m = 0.0;
  std::size_t covered = 0;
};

double cost_m(const CoveringTour& tour, const CoverAim& aim);

/// View after view, each time the one that finds the most per metre of detour and
/// metres_per_view, until enough is found or nothing more can be. The tour is kept short on the way
/// (improve_tour). Of equals the first.
CoveringTour greedy_tour(const CoverTask& task, const CoverAim& aim);

/// Large-neighbourhood search (Shaw 1998; Ropke, Pisinger 2006): takes 2 to 15 views out - some in
/// a row, the nearest of one, or any - and puts others in by what they find per detour and a random
/// price of a view, drops those that are not needed, and accepts the result as annealing does, from
/// 0.6 m (or 0.6 metres_per_view) of loss down to 0.01 m. Returns the cheapest tour that it met,
/// which costs no more than `from`; one that does not find enough is completed first.
/// Deterministic: `iterations` bound it, not time.
CoveringTour cheaper_tour(const CoverTask& task, const CoverAim& aim, const CoveringTour& from,
                          int iterations);

}  // namespace gnbv
