// Short open tours: from a given stop by all others, ending anywhere.
#pragma once

#include <cstddef>
#include <vector>

namespace gnbv {

/// Symmetric distances between stops, each of which has its row.
using Distances = std::vector<std::vector<double>>;

/// Along the stops in their order.
double tour_length_m(const Distances& distances_m, const std::vector<std::size_t>& tour);

/// Shortens the tour, whose first stop stays, until neither reversing a part (2-opt, Croes 1958)
/// nor moving up to three neighbours elsewhere (Or-opt, Or 1976) helps.
void improve_tour(const Distances& distances_m, std::vector<std::size_t>& tour);

/// The same again and again after random kicks, `kicks` times (iterated local search, Martin, Otto,
/// Felten 1991: the double bridge); of each two tours the shorter one is kept. Deterministic.
void improve_tour_with_kicks(const Distances& distances_m, std::vector<std::size_t>& tour,
                             int kicks);

}  // namespace gnbv
