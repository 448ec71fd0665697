#include "planner/tour/orienteering.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "sim/core/pose.hpp"
#include "sim/core/rng.hpp"

namespace gnbv {
namespace {

double random(std::uint64_t seed, std::uint64_t frame, std::uint64_t index) {
  return uniform01({seed, Stream::bench, frame, index});
}

/// Views at nodes of their own in a square of 10 m, each with a third of the items.
struct RandomProblem {
  explicit RandomProblem(std::uint64_t seed, std::uint32_t views = 7) {
    for (std::uint32_t p = 0; p <= views; ++p) {
      p_m.emplace_back(10.0 * random(seed, 1, p), 10.0 * random(seed, 2, p), 0.0);
    }
    for (const Vec3& from_m : p_m) {
      rows_m.emplace_back();
      for (const Vec3& to_m : p_m) {
        rows_m.back().push_back(static_cast<float>((to_m - from_m).norm()));
      }
    }
    for (std::uint32_t i = 0; i < 24; ++i) {
      problem.weight.push_back(static_cast<float>(0.2 + random(seed, 3, i)));
    }
    for (std::uint32_t v = 0; v < views; ++v) {
      problem.node.push_back(v + 1);
      problem.observations.emplace_back();
      for (std::uint32_t i = 0; i < 24; ++i) {
        if (random(seed, 10 + v, i) < 0.33) problem.observations.back().push_back({i, 0.9F});
      }
    }
    problem.cost_per_m = 0.3;
    problem.metres_per_view = 0.3;
    problem.row_m = [this](std::uint32_t node) -> std::span<const float> { return rows_m[node]; };
  }

  double found(std::span<const std::uint32_t> views) const {
    std::vector<double> missed(problem.weight.size(), 1.0);
    for (const std::uint32_t v : views) {
      for (const ItemObservation& one : problem.observations[v]) missed[one.item] *= 0.1;
    }
    double sum = 0.0;
    for (std::size_t i = 0; i < missed.size(); ++i) {
      sum += static_cast<double>(problem.weight[i]) * (1.0 - missed[i]);
    }
    return sum;
  }
  double worth(std::span<const std::uint32_t> views) const {
    double length_m = 0.0;
    std::uint32_t at = 0;
    for (const std::uint32_t v : views) {
      length_m += (p_m[v + 1] - p_m[at]).norm();
      at = v + 1;
    }
    return found(views) - problem.cost_per_m * (length_m + problem.metres_per_view *
                                                               static_cast<double>(views.size()));
  }
  /// Of all subsets in all orders.
  double best_worth() const {
    double best = 0.0;
    const auto views = static_cast<std::uint32_t>(problem.observations.size());
    for (std::uint32_t mask = 1; mask < 1U << views; ++mask) {
      std::vector<std::uint32_t> some;
      for (std::uint32_t v = 0; v < views; ++v) {
        if ((mask >> v & 1U) != 0) some.push_back(v);
      }
      do {
        best = std::max(best, worth(some));
      } while (std::next_permutation(some.begin(), some.end()));
    }
    return best;
  }

  std::vector<Vec3> p_m;
  std::vector<std::vector<float>> rows_m;
  OrienteeringProblem problem;
};

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
  random_one.problem.cost_per_m = 1000.0;
  const OrienteeringTour tour = solve(random_one.problem, {}, 100, 1);
  EXPECT_TRUE(tour.views.empty());
  EXPECT_EQ(tour.worth, 0.0);
}

TEST(OrienteeringTour, TheSameSeedFindsTheSame) {
  const RandomProblem random_one(9, 40);
  EXPECT_EQ(solve(random_one.problem, {}, 100, 4).views,
            solve(random_one.problem, {}, 100, 4).views);
}

}  // namespace
}  // namespace gnbv
