#include "bench/limits/lattice_ways.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>

#include "sim/core/error.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {

LatticeWays::LatticeWays(const RayScene& scene, const LegalViewpoints& legal, double radius_m)
    : scene_(scene), legal_(legal), radius_m_(radius_m) {}

const Vec3& LatticeWays::p_world_m(std::size_t place) const {
  return place == start() ? legal_.start_world_m : legal_.p_world_m[place];
}

LatticeWays::Tree LatticeWays::grow(std::size_t from) const {
  Tree tree{std::vector<double>(legal_.size() + 1, std::numeric_limits<double>::infinity()),
            std::vector<std::uint32_t>(legal_.size() + 1, static_cast<std::uint32_t>(from))};
  using Open = std::pair<double, std::size_t>;  // of equally near places the first comes first
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  const auto reach = [&](std::size_t place, std::size_t before, double length_m) {
    if (length_m >= tree.length_m[place]) return;
    tree.length_m[place] = length_m;
    tree.before[place] = static_cast<std::uint32_t>(before);
    open.push({length_m, place});
  };
  reach(from, from, 0.0);
  std::vector<std::uint8_t> is_near_start(legal_.size() + 1, 0);
  for (const std::uint32_t place : legal_.near_start) is_near_start[place] = 1;
  while (!open.empty()) {
    const auto [length_m, place] = open.top();
    open.pop();
    if (length_m > tree.length_m[place]) continue;
    const auto go = [&](std::size_t next) {
      reach(next, place, length_m + (p_world_m(next) - p_world_m(place)).norm());
    };
    for (const std::uint32_t next : place == start() ? legal_.near_start : legal_.neighbours[place])
      go(next);
    if (is_near_start[place] != 0) go(start());
  }
  return tree;
}

void LatticeWays::prepare(const std::vector<std::size_t>& from, int threads) {
  std::vector<std::size_t> missing;
  for (const std::size_t place : from) {
    GNBV_CHECK(place <= start(), "place {} of {}", place, start() + 1);
    if (!trees_.contains(place)) missing.push_back(place);
  }
  std::vector<Tree> grown(missing.size());
  parallel_for(threads, missing.size(), [&](std::size_t i) { grown[i] = grow(missing[i]); });
  for (std::size_t i = 0; i < missing.size(); ++i) trees_[missing[i]] = std::move(grown[i]);
}

bool LatticeWays::is_straight_clear(std::size_t from, std::size_t to) const {
  // the same answer in both directions
  const auto [a, b] = std::minmax(from, to);
  return legal_.no_fly.allows_leg(p_world_m(a), p_world_m(b)) &&
         is_leg_clear(scene_, p_world_m(a), p_world_m(b), radius_m_);
}

Way LatticeWays::way(std::size_t from, std::size_t to) const {
  const double straight_m = (p_world_m(to) - p_world_m(from)).norm();
  if (from == to || is_straight_clear(from, to)) return {straight_m};
  const Tree& tree = trees_.at(from);
  GNBV_CHECK(std::isfinite(tree.length_m[to]), "no way from place {} to {}", from, to);
  std::vector<std::size_t> places = {to};
  while (places.back() != from) places.push_back(tree.before[places.back()]);
  std::reverse(places.begin(), places.end());
  Way way;
  for (std::size_t at = 0; at + 1 < places.size();) {
    std::size_t next = places.size() - 1;
    while (next > at + 1 && !is_straight_clear(places[at], places[next])) --next;
    way.length_m += (p_world_m(places[next]) - p_world_m(places[at])).norm();
    at = next;
    if (at + 1 < places.size()) way.via_world_m.push_back(p_world_m(places[at]));
  }
  return way;
}

double LatticeWays::straight_m(std::size_t from, std::size_t to) const {
  return (p_world_m(to) - p_world_m(from)).norm();
}

double LatticeWays::guess_m(double straight_m, double lattice_m) const {
  constexpr double kMostDetour = 1.13;  // of steps to 26 neighbours in free space
  return lattice_m > kMostDetour * straight_m + 2.0 * legal_.step_m ? lattice_m : straight_m;
}

double LatticeWays::guess_m(std::size_t from, std::size_t to) const {
  return guess_m(straight_m(from, to), trees_.at(from).length_m[to]);
}

double LatticeWays::distance_m(const Tree& tree, std::size_t from, std::size_t to) const {
  const double straight_m = this->straight_m(from, to);
  const double guess_m = this->guess_m(straight_m, tree.length_m[to]);
  if (guess_m > straight_m || from == to || is_straight_clear(from, to)) return guess_m;
  return std::max(tree.length_m[to], straight_m);
}

double LatticeWays::distance_m(std::size_t from, std::size_t to) const {
  return distance_m(trees_.at(from), from, to);
}

std::vector<float> LatticeWays::distances_m(std::size_t from, std::span<const std::size_t> to,
                                            int threads) const {
  constexpr double kFar_m = 12.0;  // few legs of a short tour are longer
  constexpr std::size_t kChunk = 64;
  const Tree tree = grow(from);
  std::vector<float> distances_m(to.size());
  parallel_for_chunks(threads, to.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double straight_m = this->straight_m(from, to[i]);
      distances_m[i] =
          static_cast<float>(straight_m > kFar_m ? guess_m(straight_m, tree.length_m[to[i]])
                                                 : distance_m(tree, from, to[i]));
    }
  });
  return distances_m;
}

}  // namespace gnbv
