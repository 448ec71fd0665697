#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "planner/tour/waypoints.hpp"
#include "sim/core/pose.hpp"
#include "sim/core/rng.hpp"

namespace gnbv {
namespace {

Distances random_distances(std::uint64_t seed, std::size_t stops) {
  std::vector<Vec3> p_m(stops);
  for (std::size_t i = 0; i < stops; ++i) {
    for (std::size_t a = 0; a < 3; ++a) {
      p_m[i][static_cast<Eigen::Index>(a)] = 10.0 * uniform01({seed, Stream::bench, i, a});
    }
  }
  Distances distances_m(stops, std::vector<double>(stops));
  for (std::size_t i = 0; i < stops; ++i) {
    for (std::size_t j = 0; j < stops; ++j) distances_m[i][j] = (p_m[i] - p_m[j]).norm();
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

TEST(Tour, KeepsItsStartAndEveryStopAndOnlyGetsShorter) {
  const Distances distances_m = random_distances(3, 60);
  std::vector<std::size_t> tour = in_order(60);
  const double before_m = tour_length_m(distances_m, tour);
  improve_tour(distances_m, tour);
  const double improved_m = tour_length_m(distances_m, tour);
  EXPECT_LT(improved_m, 0.6 * before_m);
  improve_tour(distances_m, tour, 50);
  EXPECT_LE(tour_length_m(distances_m, tour), improved_m);
  EXPECT_EQ(tour.front(), 0U);
  std::sort(tour.begin(), tour.end());
  EXPECT_EQ(tour, in_order(60));
}

TEST(Tour, ImprovedNoReversalAndNoMoveOfOneStopHelps) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Distances distances_m = random_distances(seed, 40);
    std::vector<std::size_t> tour = in_order(40);
    improve_tour(distances_m, tour);
    const double length_m = tour_length_m(distances_m, tour);
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

}  // namespace
}  // namespace gnbv
