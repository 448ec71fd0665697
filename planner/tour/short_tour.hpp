// Short open tours: from a given stop by all others, ending anywhere.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace gnbv {

/// Symmetric distances between stops, each of which has its row.
using Distances = std::vector<std::vector<double>>;

/// Along the stops in their order.
double tour_length_m(const Distances& distances_m, const std::vector<std::size_t>& tour);

/// What a further stop adds to a tour at the cheapest place, its end included, and the index it
/// would get there; never 0, where the tour begins.
struct Insertion {
  double extra_m = 0.0;
  std::size_t at = 0;
};
/// `to_m`: from the further stop to each stop of the tour, in its order; `leg_m`: from each stop of
/// the tour to the next, one fewer.
Insertion cheapest_insertion(std::span<const double> to_m, std::span<const double> leg_m);

/// Shortens the tour, whose first stop stays, until neither reversing a part (2-opt, Croes 1958)
/// nor moving up to three neighbours elsewhere (Or-opt, Or 1976) helps.
void improve_tour(const Distances& distances_m, std::vector<std::size_t>& tour);

/// The same again and again after random kicks, `kicks` times (iterated local search, Martin, Otto,
/// Felten 1991: the double bridge); of each two tours the shorter one is kept. Deterministic.
void improve_tour_with_kicks(const Distances& distances_m, std::vector<std::size_t>& tour,
                             int kicks);

}  // namespace gnbv
