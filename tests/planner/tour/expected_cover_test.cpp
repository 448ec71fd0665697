#include "planner/tour/expected_cover.hpp"

#include <gtest/gtest.h>

#include "sim/core/rng.hpp"

namespace gnbv {
namespace {

double random(std::uint64_t seed, std::uint64_t frame, std::uint64_t index) {
  return uniform01({seed, Stream::bench, frame, index});
}

PrizeTask random_task(std::uint64_t seed, std::size_t views, std::size_t items) {
  PrizeTask task;
  for (std::size_t i = 0; i < items; ++i) {
    task.weight.push_back(static_cast<float>(1.0 + 9.0 * random(seed, 0, i)));
  }
  for (std::size_t v = 0; v < views; ++v) {
    task.looks.emplace_back();
    for (std::uint32_t i = 0; i < items; ++i) {
      if (random(seed, 1 + v, i) < 0.3) {
        task.looks.back().push_back({i, static_cast<float>(0.98 * random(seed, 100 + v, i))});
      }
    }
    task.place.push_back(0);
  }
  return task;
}

/// The definition, from scratch.
double found(const PrizeTask& task, const std::vector<bool>& chosen) {
  double sum = 0.0;
  for (std::uint32_t i = 0; i < task.weight.size(); ++i) {
    double missed = 1.0;
    for (std::size_t v = 0; v < task.looks.size(); ++v) {
      if (!chosen[v]) continue;
      for (const ItemLook& look : task.looks[v]) {
        if (look.item == i) missed *= 1.0 - static_cast<double>(look.success);
      }
    }
    sum += static_cast<double>(task.weight[i]) * (1.0 - missed);
  }
  return sum;
}

TEST(ExpectedCover, IsTheDefinitionAfterAnyChanges) {
  const PrizeTask task = random_task(1, 20, 30);
  const LookTable table(task);
  ExpectedCover cover(task, table);
  std::vector<bool> chosen(20, false);
  for (std::uint64_t step = 0; step < 2000; ++step) {
    const auto view = static_cast<std::uint32_t>(random_bits({2, Stream::bench, step, 0}) % 20);
    chosen[view] ? cover.remove(view) : cover.add(view);
    chosen[view] = !chosen[view];
    if (step % 50 != 0) continue;
    ASSERT_NEAR(cover.found(), found(task, chosen), 1e-6);
    for (std::uint32_t v = 0; v < 20; ++v) {
      std::vector<bool> other = chosen;
      other[v] = !other[v];
      const double difference = found(task, other) - found(task, chosen);
      const double told = chosen[v] ? -cover.loss_without(v) : cover.gains()[v];
      ASSERT_NEAR(told, difference, 1e-6) << "view " << v;
    }
  }
}

}  // namespace
}  // namespace gnbv
