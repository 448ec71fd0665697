// Small orienteering problems, and the best tour of each by brute force.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "planner/tour/orienteering.hpp"
#include "sim/core/pose.hpp"
#include "sim/core/rng.hpp"

namespace gnbv {

inline double random(std::uint64_t seed, std::uint64_t frame, std::uint64_t index) {
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
    problem.price = 0.3;
    problem.way_per_view = 0.3;
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
    return found(views) -
           problem.price * (length_m + problem.way_per_view * static_cast<double>(views.size()));
  }
  double best_worth() const {
    return best_of_all([this](std::span<const std::uint32_t> views) { return worth(views); });
  }
  /// Of all subsets in all orders.
  template <typename Worth>
  double best_of_all(const Worth& worth_of) const {
    double best = 0.0;
    const auto views = static_cast<std::uint32_t>(problem.observations.size());
    for (std::uint32_t mask = 1; mask < 1U << views; ++mask) {
      std::vector<std::uint32_t> some;
      for (std::uint32_t v = 0; v < views; ++v) {
        if ((mask >> v & 1U) != 0) some.push_back(v);
      }
      do {
        best = std::max(best, worth_of(std::span<const std::uint32_t>(some)));
      } while (std::next_permutation(some.begin(), some.end()));
    }
    return best;
  }

  std::vector<Vec3> p_m;
  std::vector<std::vector<float>> rows_m;
  OrienteeringProblem problem;
};

}  // namespace gnbv
