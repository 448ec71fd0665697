#include "planner/tour/neighbourhood.hpp"

#include <algorithm>
#include <utility>

namespace gnbv {

std::vector<std::uint32_t> views_to_remove(std::span<const std::uint32_t> chosen,
                                           std::span<const std::uint32_t> place_of,
                                           const Stops& stops, const RowOf& row_m, Rng& rng) {
  constexpr std::size_t kFewest = 2;
  constexpr std::size_t kMost = 15;
  const std::size_t count = std::min(chosen.size(), kFewest + rng.below(kMost - kFewest + 1));
  const std::uint32_t seed = chosen[rng.below(chosen.size())];
  const std::size_t way = rng.below(3);
  const std::span<const float> from_seed_m = row_m(place_of[seed]);
  const std::size_t first = stops.index_of(place_of[seed]);
  const std::size_t around = stops.places().size();
  std::vector<std::pair<double, std::uint32_t>> keyed;
  for (const std::uint32_t view : chosen) {
    double key = 0.0;
    if (way == 0) {  // in a row: the stops from the seed's on, then from the start
      key = static_cast<double>((stops.index_of(place_of[view]) + around - first) % around);
    } else if (way == 1) {
      key = static_cast<double>(from_seed_m[place_of[view]]);
    } else {
      key = rng.uniform();
    }
    keyed.emplace_back(key, view);
  }
  std::sort(keyed.begin(), keyed.end());
  std::vector<std::uint32_t> views;
  for (std::size_t i = 0; i < count; ++i) views.push_back(keyed[i].second);
  return views;
}

std::vector<double> random_likings(std::size_t views, Rng& rng) {
  const double most_off = std::max(0.0, 2.0 * rng.uniform() - 1.0);
  std::vector<double> likings;
  if (most_off == 0.0) return likings;
  for (std::size_t view = 0; view < views; ++view) {
    likings.push_back(1.0 - most_off * rng.uniform());
  }
  return likings;
}

}  // namespace gnbv
