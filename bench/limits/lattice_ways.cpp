#include "bench/limits/lattice_ways.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "sim/core/error.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {

LatticeWays::LatticeWays(const RayScene& scene, const LegalViewpoints& legal, double radius_m)
    : scene_(scene), legal_(legal), radius_m_(radius_m), first_leg_{0} {
  std::vector<std::uint8_t> is_near_start(legal.size(), 0);
  for (const std::uint32_t place : legal.near_start) is_near_start[place] = 1;
  for (std::size_t place = 0; place <= start(); ++place) {
    const auto add = [&](std::size_t to) {
      legs_.push_back({static_cast<std::uint32_t>(to), straight_m(place, to)});
    };
    for (const std::uint32_t to : place == start() ? legal.near_start : legal.neighbours[place]) {
      add(to);
    }
    if (place != start() && is_near_start[place] != 0) add(start());
    first_leg_.push_back(legs_.size());
  }
}

const Vec3& LatticeWays::p_world_m(std::size_t place) const {
  return place == start() ? legal_.start_world_m : legal_.p_world_m[place];
}

// Dijkstra's order without a heap (Denardo and Fox 1979): places wait in buckets as wide as a step
// of the lattice, so that next to none in a bucket is reached twice; one that is goes again. Of
// equally short ways a place keeps that by the nearest place before it, of those the first one.
LatticeWays::Tree LatticeWays::grow(std::size_t from) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Tree tree{std::vector<double>(legal_.size() + 1, kInfinity),
            std::vector<std::uint32_t>(legal_.size() + 1, static_cast<std::uint32_t>(from))};
  std::vector<double> left_m(legal_.size() + 1, kInfinity);  // how long a place's way was then
  std::vector<std::vector<std::uint32_t>> buckets;
  const auto wait = [&](std::uint32_t place) {
    const auto bucket = static_cast<std::size_t>(tree.length_m[place] / legal_.step_m);
    if (bucket >= buckets.size()) buckets.resize(bucket + 1);
    buckets[bucket].push_back(place);
  };
  const auto is_before = [&](std::uint32_t a, std::uint32_t b) {
    const auto order = [&](std::uint32_t place) {
      return std::tuple(tree.length_m[place], place != from, place);
    };
    return order(a) < order(b);
  };
  tree.length_m[from] = 0.0;
  wait(static_cast<std::uint32_t>(from));
  for (std::size_t bucket = 0; bucket < buckets.size(); ++bucket) {
    for (std::size_t i = 0; i < buckets[bucket].size(); ++i) {
      const std::uint32_t place = buckets[bucket][i];
      if (left_m[place] == tree.length_m[place]) continue;
      left_m[place] = tree.length_m[place];
      for (const Leg& leg : legs_from(place)) {
        const double length_m = left_m[place] + leg.length_m;
        if (length_m > tree.length_m[leg.to]) continue;
        if (length_m == tree.length_m[leg.to]) {
          if (is_before(place, tree.before[leg.to])) tree.before[leg.to] = place;
          continue;
        }
        tree.length_m[leg.to] = length_m;
        tree.before[leg.to] = place;
        wait(leg.to);
      }
    }
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
  if (from == to || is_straight_clear(from, to)) return {straight_m(from, to)};
  const Tree& tree = trees_.at(from);
  GNBV_CHECK(std::isfinite(tree.length_m[to]), "no way from place {} to {}", from, to);
  std::vector<std::size_t> places = {to};
  while (places.back() != from) places.push_back(tree.before[places.back()]);
  std::reverse(places.begin(), places.end());
  Way way;
  for (std::size_t at = 0; at + 1 < places.size();) {
    std::size_t next = places.size() - 1;
    while (next > at + 1 && !is_straight_clear(places[at], places[next])) --next;
    way.length_m += straight_m(places[at], places[next]);
    at = next;
    if (at + 1 < places.size()) way.via_world_m.push_back(p_world_m(places[at]));
  }
  return way;
}

std::vector<float> LatticeWays::distances_m(std::size_t from, std::span<const std::size_t> to,
                                            int threads) const {
  constexpr double kFar_m = 12.0;       // few legs of a short tour are longer
  constexpr double kMostDetour = 1.13;  // of steps to 26 neighbours in free space
  constexpr std::size_t kChunk = 64;
  const Tree tree = grow(from);
  const auto distance_m = [&](std::size_t place) {
    const double straight_m = this->straight_m(from, place);
    const double lattice_m = tree.length_m[place];
    if (lattice_m > kMostDetour * straight_m + 2.0 * legal_.step_m) return lattice_m;
    const bool is_straight = straight_m > kFar_m || from == place || is_straight_clear(from, place);
    return is_straight ? straight_m : std::max(lattice_m, straight_m);
  };
  std::vector<float> distances_m(to.size());
  parallel_for_chunks(threads, to.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      distances_m[i] = static_cast<float>(distance_m(to[i]));
    }
  });
  return distances_m;
}

}  // namespace gnbv
