#include <gtest/gtest.h>

#include "planner/tour/orienteering.hpp"
#include "sim/core/rng.hpp"

namespace gnbv {
namespace {

double random(std::uint64_t seed, std::uint64_t frame, std::uint64_t index) {
  return uniform01({seed, Stream::bench, frame, index});
}

OrienteeringProblem random_problem(std::uint64_t seed, std::size_t views, std::size_t items) {
  OrienteeringProblem problem;
  for (std::size_t i = 0; i < items; ++i) {
    problem.weight.push_back(static_cast<float>(1.0 + 9.0 * random(seed, 0, i)));
  }
  for (std::size_t v = 0; v < views; ++v) {
    problem.observations.emplace_back();
    for (std::uint32_t i = 0; i < items; ++i) {
      if (random(seed, 1 + v, i) < 0.3) {
        problem.observations.back().push_back(
            {i, static_cast<float>(0.98 * random(seed, 100 + v, i))});
      }
    }
    problem.node.push_back(0);
  }
  return problem;
}

/// The definition, from scratch.
double found(const OrienteeringProblem& problem, const std::vector<bool>& chosen) {
  double sum = 0.0;
  for (std::uint32_t i = 0; i < problem.weight.size(); ++i) {
    double missed = 1.0;
    for (std::size_t v = 0; v < problem.observations.size(); ++v) {
      if (!chosen[v]) continue;
      for (const ItemObservation& one : problem.observations[v]) {
        if (one.item == i) missed *= 1.0 - static_cast<double>(one.success);
      }
    }
    sum += static_cast<double>(problem.weight[i]) * (1.0 - missed);
  }
  return sum;
}

TEST(ExpectedCover, IsTheDefinitionAfterAnyChanges) {
  const OrienteeringProblem problem = random_problem(1, 20, 30);
  ExpectedCover cover(problem);
  std::vector<bool> chosen(20, false);
  for (std::uint64_t step = 0; step < 2000; ++step) {
    const auto view = static_cast<std::uint32_t>(random_bits({2, Stream::bench, step, 0}) % 20);
    chosen[view] = !chosen[view];
    cover.set(view, chosen[view]);
    if (step % 50 != 0) continue;
    ASSERT_NEAR(cover.found(), found(problem, chosen), 1e-6);
    for (std::uint32_t v = 0; v < 20; ++v) {
      std::vector<bool> other = chosen;
      other[v] = !other[v];
      const double difference = found(problem, other) - found(problem, chosen);
      const double told = chosen[v] ? -cover.loss_without(v) : cover.gains()[v];
      ASSERT_NEAR(told, difference, 1e-6) << "view " << v;
    }
  }
}

}  // namespace
}  // namespace gnbv
