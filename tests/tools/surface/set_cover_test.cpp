#include "tools/surface/set_cover.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "sim/core/rng.hpp"
#include "tools/surface/rectangle_packing.hpp"

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

// Laws of packed rectangles.

std::vector<RectangleSize> made_sizes(std::size_t count, int largest) {
  std::vector<RectangleSize> sizes;
  for (std::size_t i = 0; i < count; ++i) {
    const auto side = [&](std::uint64_t axis) {
      return 1 + static_cast<int>(largest * uniform01({7, Stream::bench, i, axis}));
    };
    sizes.push_back({side(0), side(1)});
  }
  return sizes;
}

/// Share of the sheet that they fill, each texel once.
double filled_share(const std::vector<RectangleSize>& sizes, const Packing& packing) {
  const auto width = static_cast<std::size_t>(packing.width);
  std::vector<std::uint8_t> is_taken(width * static_cast<std::size_t>(packing.height));
  std::size_t taken = 0;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const auto [x, y] = packing.corners[i];
    EXPECT_TRUE(x >= 0 && y >= 0 && x + sizes[i].width <= packing.width &&
                y + sizes[i].height <= packing.height)
        << i;
    for (int row = y; row < y + sizes[i].height; ++row) {
      for (int column = x; column < x + sizes[i].width; ++column) {
        const std::size_t at =
            static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column);
        if (is_taken.at(at)++ != 0) ADD_FAILURE() << i << " overlaps another";
        ++taken;
      }
    }
  }
  return static_cast<double>(taken) / static_cast<double>(is_taken.size());
}

TEST(Packing, RectanglesKeepApartAndLeaveLittle) {
  for (const auto& [count, largest, side] : {std::tuple{300UL, 50, 512}, {40'000UL, 60, 8192}}) {
    const std::vector<RectangleSize> sizes = made_sizes(count, largest);
    const std::optional<Packing> packing = packed(sizes, 8192);
    ASSERT_TRUE(packing.has_value());
    EXPECT_EQ(packing->width, side);
    EXPECT_LE(packing->height, packing->width);
    EXPECT_GT(filled_share(sizes, *packing), 0.95) << count;
    const Packing again = packed(sizes, 8192).value();
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_EQ(again.corners[i].x, packing->corners[i].x);
      EXPECT_EQ(again.corners[i].y, packing->corners[i].y);
    }
  }
}

TEST(Packing, TheSheetIsTheNarrowestOrThereIsNone) {
  EXPECT_EQ(packed(std::vector<RectangleSize>{{90, 90}}, 100).value().width, 100);
  EXPECT_EQ(packed(std::vector<RectangleSize>{{60, 60}, {4, 4}}, 100).value().width, 64);
  EXPECT_FALSE(packed(made_sizes(300, 50), 128).has_value());
  EXPECT_FALSE(packed(std::vector<RectangleSize>{{70, 1}}, 64).has_value());
  EXPECT_FALSE(packed(std::vector<RectangleSize>{{1, 70}}, 64).has_value());
}

}  // namespace
}  // namespace gnbv
