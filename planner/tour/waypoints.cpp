#include "planner/tour/waypoints.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace gnbv {
namespace {

constexpr double kWorthwhile_m = 1e-9;  // less is rounding, and might go on for ever

using Tour = std::vector<std::size_t>;

auto at(std::size_t i) { return static_cast<std::ptrdiff_t>(i); }

/// Makes the first change that it finds to shorten the tour; false where there is none. A change
/// replaces the legs at the ends of a part.
bool improve_once(const Distances& distances_m, Tour& tour) {
  const auto leg = [&](std::size_t i, std::size_t j) {  // 0 where j is beyond the last stop
    return j < tour.size() ? distances_m[tour[i]][tour[j]] : 0.0;
  };
  // 2-opt: turns round stops i to j
  for (std::size_t i = 1; i < tour.size(); ++i) {
    for (std::size_t j = i + 1; j < tour.size(); ++j) {
      const double before_m = leg(i - 1, i) + leg(j, j + 1);
      const double after_m = leg(i - 1, j) + leg(i, j + 1);
      if (before_m - after_m <= kWorthwhile_m) continue;
      std::reverse(tour.begin() + at(i), tour.begin() + at(j + 1));
      return true;
    }
  }
  // Or-opt: puts stops i to `last` between stop k and the next, either way round
  for (std::size_t length = 1; length <= 3; ++length) {
    for (std::size_t i = 1; i + length <= tour.size(); ++i) {
      const std::size_t last = i + length - 1;
      const double saved_m = leg(i - 1, i) + leg(last, last + 1) - leg(i - 1, last + 1);
      for (std::size_t k = 0; k < tour.size(); ++k) {
        if (k + 1 >= i && k <= last) continue;
        const double gap_m = leg(k, k + 1);
        const double same_m = leg(k, i) + leg(last, k + 1) - gap_m;
        const double turned_m = leg(k, last) + leg(i, k + 1) - gap_m;
        if (saved_m - std::min(same_m, turned_m) <= kWorthwhile_m) continue;
        const auto first = tour.begin() + at(i);
        const auto end = tour.begin() + at(last + 1);
        const auto to = tour.begin() + at(k + 1);
        if (turned_m < same_m) std::reverse(first, end);
        std::rotate(std::min(first, to), k < i ? first : end, std::max(end, to));
        return true;
      }
    }
  }
  return false;
}

void improve(const Distances& distances_m, Tour& tour) {
  while (improve_once(distances_m, tour)) {
  }
}

/// Swaps two neighbouring parts of the tour.
Tour kicked(const Tour& tour, std::uint64_t kick) {
  std::array<std::size_t, 3> cuts{};
  for (std::size_t c = 0; c < cuts.size(); ++c) {
    cuts[c] = 1 + random_bits({0, Stream::bench, kick, c}) % tour.size();
  }
  std::sort(cuts.begin(), cuts.end());
  Tour other = tour;
  std::rotate(other.begin() + at(cuts[0]), other.begin() + at(cuts[1]),
              other.begin() + at(cuts[2]));
  return other;
}

}  // namespace

double tour_length_m(const Distances& distances_m, const Tour& tour) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < tour.size(); ++i) length_m += distances_m[tour[i - 1]][tour[i]];
  return length_m;
}

void improve_tour(const Distances& distances_m, Tour& tour, int kicks) {
  improve(distances_m, tour);
  if (tour.size() < 4) return;  // the first of them stays: two others are both ways round alike
  double length_m = tour_length_m(distances_m, tour);
  for (int kick = 0; kick < kicks; ++kick) {
    Tour other = kicked(tour, static_cast<std::uint64_t>(kick));
    improve(distances_m, other);
    const double other_m = tour_length_m(distances_m, other);
    if (length_m - other_m <= kWorthwhile_m) continue;
    tour = std::move(other);
    length_m = other_m;
  }
}

std::size_t Waypoints::index_of(std::uint32_t node) const {
  return static_cast<std::size_t>(std::find(nodes_.begin(), nodes_.end(), node) - nodes_.begin());
}

double Waypoints::length_m() const {
  double length_m = 0.0;
  for (std::size_t i = 1; i < nodes_.size(); ++i) length_m += leg_m(nodes_[i - 1], nodes_[i]);
  return length_m;
}

double Waypoints::saved_without_m(std::uint32_t node) const {
  const std::size_t i = index_of(node);
  const double to_m = leg_m(nodes_[i - 1], node);
  if (i + 1 == nodes_.size()) return to_m;
  return to_m + leg_m(node, nodes_[i + 1]) - leg_m(nodes_[i - 1], nodes_[i + 1]);
}

void Waypoints::remove(std::uint32_t node) { nodes_.erase(nodes_.begin() + at(index_of(node))); }

void Waypoints::find_rows() {
  rows_m_.clear();
  for (const std::uint32_t node : nodes_) rows_m_.push_back((*row_m_)(node).data());
}

/// A visit to node n between the waypoints a and b adds d(a, n) + d(n, b) - d(a, b); behind the
/// last one, z, it adds d(z, n). The least of these is kept, with where it comes. Each pass runs
/// over all nodes in memory order, so that it is vectorized. Where ways are not the shortest, the
/// least may be below 0.
void Waypoints::find_detours() {
  find_rows();
  const std::size_t nodes = (*row_m_)(nodes_.back()).size();
  extra_m_.assign(rows_m_.back(), rows_m_.back() + nodes);
  at_.assign(nodes, static_cast<std::int32_t>(nodes_.size()));
  float* const least_m = extra_m_.data();
  std::int32_t* const position = at_.data();
  for (std::size_t i = 1; i < nodes_.size(); ++i) {
    const float* const from_m = rows_m_[i - 1];
    const float way_m = from_m[nodes_[i]];
    const float leg_m = std::isfinite(way_m) ? way_m : 0.0F;
    const float* const to_m = rows_m_[i];
    for (std::size_t n = 0; n < nodes; ++n) {
      const float extra = from_m[n] + to_m[n] - leg_m;
      position[n] = extra < least_m[n] ? static_cast<std::int32_t>(i) : position[n];
      least_m[n] = std::min(extra, least_m[n]);
    }
  }
  for (std::size_t n = 0; n < nodes; ++n) least_m[n] = std::max(least_m[n], 0.0F);
  for (const std::uint32_t node : nodes_) extra_m_[node] = 0.0F;
}

void Waypoints::insert(std::uint32_t node) {
  nodes_.insert(nodes_.begin() + at_[node], node);
  find_detours();
}

/// The improvement needs ways that are as long both ways round, and that lead somewhere.
void Waypoints::shorten(int kicks) {
  constexpr float kNoWay_m = 1e6F;
  find_rows();
  Distances distances_m(nodes_.size(), std::vector<double>(nodes_.size()));
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    for (std::size_t j = 0; j < nodes_.size(); ++j) {
      distances_m[i][j] = std::min({rows_m_[i][nodes_[j]], rows_m_[j][nodes_[i]], kNoWay_m});
    }
  }
  Tour order(nodes_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  improve_tour(distances_m, order, kicks);
  std::vector<std::uint32_t> nodes;
  for (const std::size_t waypoint : order) nodes.push_back(nodes_[waypoint]);
  nodes_ = std::move(nodes);
}

std::vector<std::uint32_t> views_to_remove(std::span<const std::uint32_t> chosen,
                                           std::span<const std::uint32_t> node_of,
                                           const Waypoints& waypoints, const RowOf& row_m,
                                           Rng& rng) {
  constexpr std::size_t kFewest = 2;
  constexpr std::size_t kMost = 15;
  const std::size_t count = std::min(chosen.size(), kFewest + rng.below(kMost - kFewest + 1));
  const std::uint32_t first_node = node_of[chosen[rng.below(chosen.size())]];
  const std::size_t way = rng.below(3);
  const std::span<const float> from_first_m = row_m(first_node);
  const std::size_t first = waypoints.index_of(first_node);
  const std::size_t around = waypoints.nodes().size();
  std::vector<std::pair<double, std::uint32_t>> keyed;
  for (const std::uint32_t view : chosen) {
    const std::uint32_t node = node_of[view];
    // in a row: the waypoints from the first view's on, then from the start
    const std::size_t after = (waypoints.index_of(node) + around - first) % around;
    keyed.emplace_back(way == 0   ? static_cast<double>(after)
                       : way == 1 ? from_first_m[node]
                                  : rng.uniform(),
                       view);
  }
  std::sort(keyed.begin(), keyed.end());
  std::vector<std::uint32_t> views;
  for (std::size_t i = 0; i < count; ++i) views.push_back(keyed[i].second);
  return views;
}

std::vector<double> perturbation_weights(std::size_t views, Rng& rng) {
  const double most_off = std::max(0.0, 2.0 * rng.uniform() - 1.0);
  std::vector<double> weights;
  for (std::size_t view = 0; view < views && most_off > 0.0; ++view) {
    weights.push_back(1.0 - most_off * rng.uniform());
  }
  return weights;
}

}  // namespace gnbv
