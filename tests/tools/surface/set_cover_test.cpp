#include "tools/surface/set_cover.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/core/rng.hpp"

namespace gnbv {
namespace {

using Sets = std::vector<std::vector<std::uint32_t>>;

constexpr std::uint32_t kItems = 24;

Sets random_sets(std::uint64_t seed, std::size_t count) {
  Sets sets(count);
  for (std::size_t s = 0; s < count; ++s) {
    for (std::uint32_t item = 0; item < kItems; ++item) {
      if (uniform01({seed, Stream::bench, s, item}) < 0.25) sets[s].push_back(item);
    }
  }
  return sets;
}

std::vector<double> random_costs(std::uint64_t seed, std::size_t count) {
  std::vector<double> costs;
  for (std::size_t s = 0; s < count; ++s) {
    // quarters, so that ties occur
    costs.push_back(0.25 * (1.0 + std::floor(4.0 * uniform01({seed, Stream::bench, 1000, s}))));
  }
  return costs;
}

std::vector<const std::vector<std::uint32_t>*> pointers(const Sets& sets) {
  std::vector<const std::vector<std::uint32_t>*> out;
  for (const auto& set : sets) out.push_back(&set);
  return out;
}

std::vector<std::size_t> lazy_choices(const Sets& sets, std::uint64_t seed, bool with_costs) {
  LazyGreedy greedy(pointers(sets), kItems);
  std::vector<std::size_t> choices;
  while (true) {
    const auto costs = with_costs ? random_costs(seed + choices.size(), sets.size())
                                  : std::vector<double>(sets.size(), 1.0);
    const auto best = greedy.best(costs);
    if (!best) return choices;
    greedy.take(sets[*best]);
    choices.push_back(*best);
  }
}

/// The slow twin: every gain counted every time.
std::vector<std::size_t> plain_choices(const Sets& sets, std::uint64_t seed, bool with_costs) {
  std::vector<bool> taken(kItems, false);
  std::vector<std::size_t> choices;
  while (true) {
    const auto costs = with_costs ? random_costs(seed + choices.size(), sets.size())
                                  : std::vector<double>(sets.size(), 1.0);
    double best = 0.0;
    std::size_t chosen = sets.size();
    for (std::size_t s = 0; s < sets.size(); ++s) {
      double gain = 0.0;
      for (const std::uint32_t item : sets[s]) gain += taken[item] ? 0.0 : 1.0;
      if (gain / costs[s] > best) {
        best = gain / costs[s];
        chosen = s;
      }
    }
    if (chosen == sets.size()) return choices;
    for (const std::uint32_t item : sets[chosen]) taken[item] = true;
    choices.push_back(chosen);
  }
}

/// Of the items that any set holds.
std::size_t fewest_sets(const Sets& sets) {
  std::vector<std::uint32_t> masks;
  std::uint32_t all = 0;
  for (const auto& set : sets) {
    masks.push_back(0);
    for (const std::uint32_t item : set) masks.back() |= 1U << item;
    all |= masks.back();
  }
  std::size_t fewest = sets.size();
  for (std::uint32_t some = 0; some < 1U << sets.size(); ++some) {
    std::uint32_t covered = 0;
    std::size_t count = 0;
    for (std::size_t s = 0; s < sets.size(); ++s) {
      if ((some >> s & 1U) == 0) continue;
      covered |= masks[s];
      ++count;
    }
    if (covered == all) fewest = std::min(fewest, count);
  }
  return fewest;
}

TEST(LazyGreedy, ChoosesAsThePlainAlgorithm) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const Sets sets = random_sets(seed, 30);
    for (const bool with_costs : {false, true}) {
      EXPECT_EQ(lazy_choices(sets, seed, with_costs), plain_choices(sets, seed, with_costs))
          << seed << with_costs;
    }
  }
}

TEST(LazyGreedy, KeepsItsBoundAgainstTheBestCover) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const Sets sets = random_sets(seed, 12);
    std::size_t largest = 0;
    for (const auto& set : sets) largest = std::max(largest, set.size());
    const double bound = std::log(static_cast<double>(largest)) + 1.0;
    const auto choices = lazy_choices(sets, seed, false);
    const std::size_t fewest = fewest_sets(sets);
    EXPECT_GE(choices.size(), fewest) << seed;
    EXPECT_LE(static_cast<double>(choices.size()), bound * static_cast<double>(fewest)) << seed;
  }
}

TEST(LazyGreedy, CountsWhatCameFromElsewhere) {
  const Sets sets = {{0, 1, 2}, {3}};
  LazyGreedy greedy(pointers(sets), 5);
  EXPECT_EQ(greedy.take(std::vector<std::uint32_t>{0, 1, 2, 4}), 4U);
  EXPECT_EQ(greedy.best(std::vector<double>{1.0, 1.0}), 1U);
  EXPECT_EQ(greedy.take(sets[1]), 1U);
  EXPECT_EQ(greedy.take(sets[1]), 0U);
  EXPECT_FALSE(greedy.best(std::vector<double>{1.0, 1.0}));
}

}  // namespace
}  // namespace gnbv
