#include "planner/tour/perturbation.hpp"

#include <algorithm>
#include <utility>

namespace gnbv {

std::vector<std::uint32_t> views_to_remove(std::span<const std::uint32_t> chosen,
                                           std::span<const std::uint32_t> node_of,
                                           const Waypoints& waypoints, const RowOf& row_m,
                                           Rng& rng) {
  constexpr std::size_t kFewest = 2;
  constexpr std::size_t kMost = 15;
  const std::size_t count = std::min(chosen.size(), kFewest + rng.below(kMost - kFewest + 1));
  const std::uint32_t first_view = chosen[rng.below(chosen.size())];
  const std::size_t way = rng.below(3);
  const std::span<const float> from_first_m = row_m(node_of[first_view]);
  const std::size_t first = waypoints.index_of(node_of[first_view]);
  const std::size_t around = waypoints.nodes().size();
  std::vector<std::pair<double, std::uint32_t>> keyed;
  for (const std::uint32_t view : chosen) {
    double key = 0.0;
    if (way == 0) {  // in a row: the waypoints from the first view's on, then from the start
      key = static_cast<double>((waypoints.index_of(node_of[view]) + around - first) % around);
    } else if (way == 1) {
      key = static_cast<double>(from_first_m[node_of[view]]);
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

std::vector<double> perturbation_weights(std::size_t views, Rng& rng) {
  const double most_off = std::max(0.0, 2.0 * rng.uniform() - 1.0);
  std::vector<double> weights;
  if (most_off == 0.0) return weights;
  for (std::size_t view = 0; view < views; ++view)
    weights.push_back(1.0 - most_off * rng.uniform());
  return weights;
}

}  // namespace gnbv
