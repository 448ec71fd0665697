#include "planner/tour/waypoints.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/core/rng.hpp"

namespace gnbv {
namespace {

double random(std::uint64_t seed, std::uint64_t from, std::uint64_t to) {
  return uniform01({seed, Stream::bench, from, to});
}

/// Ways of any length, some of which lead nowhere: no metric, and not the same both ways.
struct RandomWays {
  explicit RandomWays(std::uint64_t seed, std::size_t nodes) : rows_m(nodes) {
    for (std::size_t from = 0; from < nodes; ++from) {
      for (std::size_t to = 0; to < nodes; ++to) {
        const bool leads_there = random(seed, from, to) > 0.1;
        const auto length_m =
            static_cast<float>(1.0 + std::floor(8.0 * random(seed + 1, from, to)));
        rows_m[from].push_back(leads_there ? length_m : std::numeric_limits<float>::infinity());
      }
      rows_m[from][from] = 0.0F;
    }
  }
  std::vector<std::vector<float>> rows_m;
  RowOf row_m = [this](std::uint32_t node) -> std::span<const float> { return rows_m[node]; };
};

TEST(Waypoints, DetoursAfterAnInsertionAreThoseFoundAnew) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const RandomWays ways(seed, 30);
    Waypoints waypoints({0}, ways.row_m);
    waypoints.find_detours();
    for (std::uint32_t node = 3; node < 30; node += 4) {
      if (!std::isfinite(waypoints.extra_m()[node])) continue;
      waypoints.insert(node);
      Waypoints anew(waypoints.nodes(), ways.row_m);
      anew.find_detours();
      const std::vector<float> extra_m(waypoints.extra_m().begin(), waypoints.extra_m().end());
      EXPECT_EQ(extra_m, std::vector<float>(anew.extra_m().begin(), anew.extra_m().end()));
      for (std::uint32_t next = 1; next < 30; ++next) {  // and a further stop goes to one position
        if (waypoints.has(next) || !std::isfinite(extra_m[next])) continue;
        Waypoints one = waypoints;
        Waypoints other = anew;
        one.insert(next);
        other.insert(next);
        EXPECT_EQ(one.nodes(), other.nodes());
      }
    }
  }
}

TEST(Waypoints, ShorteningEndsWhateverTheWays) {
  for (std::uint64_t seed = 100; seed < 120; ++seed) {
    const RandomWays ways(seed, 12);
    std::vector<std::uint32_t> nodes(12);
    for (std::uint32_t i = 0; i < 12; ++i) nodes[i] = i;
    Waypoints waypoints(nodes, ways.row_m);
    waypoints.shorten();
    EXPECT_EQ(waypoints.nodes().front(), 0U);
    EXPECT_EQ(waypoints.nodes().size(), 12U);
  }
}

}  // namespace
}  // namespace gnbv
