#include "planner/tour/orienteering.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "planner/tour/waypoints.hpp"
#include "tests/planner/tour/random_problem.hpp"

namespace gnbv {
namespace {

TEST(OrienteeringTour, IsTheBestOfAllWhereTheyCanBeCountedOrNextToIt) {
  constexpr std::uint64_t kTasks = 20;
  std::uint64_t best = 0;
  for (std::uint64_t seed = 0; seed < kTasks; ++seed) {
    const RandomProblem random_one(seed);
    const OrienteeringTour tour = solve(random_one.problem, {}, 300, seed);
    EXPECT_NEAR(tour.worth, random_one.worth(tour.views), 1e-4) << "what it says of itself";
    const double best_worth = random_one.best_worth();
    EXPECT_LE(tour.worth, best_worth + 1e-4);
    EXPECT_GE(tour.worth, 0.97 * best_worth) << "seed " << seed;
    if (tour.worth >= best_worth - 1e-4) ++best;
  }
  EXPECT_GE(best, kTasks - 3);
}

TEST(OrienteeringTour, IsNoWorseThanTheOneItBeginsWithNorGreed) {
  const RandomProblem random_one(5, 40);
  const OrienteeringTour greedy = solve(random_one.problem, {}, 0, 1);
  const OrienteeringTour searched = solve(random_one.problem, greedy.views, 200, 1);
  EXPECT_GE(searched.worth, greedy.worth);
  EXPECT_GT(solve(random_one.problem, {}, 500, 1).worth, greedy.worth);
}

TEST(OrienteeringTour, StaysAtHomeWhereNothingPays) {
  RandomProblem random_one(1);
  random_one.problem.price = 1000.0;
  const OrienteeringTour tour = solve(random_one.problem, {}, 100, 1);
  EXPECT_TRUE(tour.views.empty());
  EXPECT_EQ(tour.worth, 0.0);
}

Distances random_distances(std::uint64_t seed, std::size_t stops) {
  std::vector<Vec3> p_m;
  for (std::size_t i = 0; i < stops; ++i) {
    p_m.emplace_back(random(seed, i, 0), random(seed, i, 1), random(seed, i, 2));
  }
  Distances distances_m(stops);
  for (std::size_t i = 0; i < stops; ++i) {
    for (const Vec3& to_m : p_m) distances_m[i].push_back(10.0 * (to_m - p_m[i]).norm());
  }
  return distances_m;
}

std::vector<std::size_t> in_order(std::size_t stops) {
  std::vector<std::size_t> tour(stops);
  std::iota(tour.begin(), tour.end(), std::size_t{0});
  return tour;
}

double shortest_m(const Distances& distances_m) {
  std::vector<std::size_t> tour = in_order(distances_m.size());
  double best_m = tour_length_m(distances_m, tour);
  while (std::next_permutation(tour.begin() + 1, tour.end())) {
    best_m = std::min(best_m, tour_length_m(distances_m, tour));
  }
  return best_m;
}

TEST(Tour, IsTheShortestOfAllOrdersOfEightStops) {
  for (std::size_t stops = 1; stops <= 8; ++stops) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      const Distances distances_m = random_distances(seed, stops);
      std::vector<std::size_t> tour = in_order(stops);
      improve_tour(distances_m, tour, 100);
      EXPECT_NEAR(tour_length_m(distances_m, tour), shortest_m(distances_m), 1e-9)
          << stops << " stops, seed " << seed;
    }
  }
}

TEST(Tour, ImprovedItKeepsItsStopsAndNoReversalAndNoMoveOfOneStopHelps) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Distances distances_m = random_distances(seed, 40);
    std::vector<std::size_t> tour = in_order(40);
    const double before_m = tour_length_m(distances_m, tour);
    improve_tour(distances_m, tour);
    const double length_m = tour_length_m(distances_m, tour);
    EXPECT_LT(length_m, 0.6 * before_m);
    std::vector<std::size_t> again = tour;
    improve_tour(distances_m, again, 50);
    EXPECT_LE(tour_length_m(distances_m, again), length_m);
    EXPECT_EQ(again.front(), 0U);
    std::ranges::sort(again);
    EXPECT_EQ(again, in_order(40));
    for (std::size_t i = 1; i < tour.size(); ++i) {
      for (std::size_t j = 1; j < tour.size(); ++j) {
        std::vector<std::size_t> other = tour;
        if (i < j) {
          std::reverse(other.begin() + static_cast<std::ptrdiff_t>(i),
                       other.begin() + static_cast<std::ptrdiff_t>(j + 1));
          EXPECT_GE(tour_length_m(distances_m, other), length_m - 1e-8);
          other = tour;
        }
        const std::size_t stop = other[i];
        other.erase(other.begin() + static_cast<std::ptrdiff_t>(i));
        other.insert(other.begin() + static_cast<std::ptrdiff_t>(j), stop);
        EXPECT_GE(tour_length_m(distances_m, other), length_m - 1e-8);
      }
    }
  }
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
