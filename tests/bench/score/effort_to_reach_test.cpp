#include "bench/score/effort_to_reach.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "sim/core/error.hpp"
#include "sim/core/rng.hpp"

namespace gnbv {
namespace {

constexpr BeforeViews kBefore = {.profile_m = 100.0, .transfer_m = 7.0, .profile_end_s = 50.0};

/// A cloud that grows by chance, sometimes not at all.
CoverageCurve random_curve(std::uint64_t seed) {
  CoverageCurve curve;
  double share = 0.0;
  const std::size_t entries = 1 + seed % 9;
  for (std::size_t i = 0; i < entries; ++i) {
    const double u = uniform01({seed, Stream::bench, i, 0});
    share += u < 0.3 ? 0.0 : 0.2 * u;
    curve.coverage.push_back({share, 1.0, 1.0});
    curve.metres.push_back(3.0 * static_cast<double>(i) * (1.0 + u));
    curve.seconds.push_back(static_cast<double>(i) * 11.0);
  }
  std::sort(curve.metres.begin(), curve.metres.end());
  curve.metres.front() = 0.0;
  return curve;
}

TEST(EffortToReach, IsThatOfTheFirstEntryThatCoversSoMuch) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const CoverageCurve curve = random_curve(seed);
    for (int step = 0; step <= 40; ++step) {
      const double wanted = 0.03 * step;
      const auto spent = effort_to_reach(curve, kBefore, wanted);
      std::size_t first = 0;
      while (first < curve.coverage.size() && curve.coverage[first][0] < wanted) ++first;
      ASSERT_EQ(spent.has_value(), first < curve.coverage.size()) << "seed " << seed;
      if (!spent) continue;
      EXPECT_EQ(spent->views, static_cast<double>(first));
      EXPECT_EQ(spent->metres, curve.metres[first]);
      EXPECT_EQ(spent->metres_with_profile, 100.0 + (first > 0 ? 7.0 : 0.0) + curve.metres[first]);
      EXPECT_EQ(spent->seconds, curve.seconds[first]);
      EXPECT_EQ(spent->seconds_with_profile, 50.0 + curve.seconds[first]);
    }
  }
}

TEST(EffortToReach, MoreCostsNoLess) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const CoverageCurve curve = random_curve(seed);
    std::optional<EffortSpent> last = EffortSpent{};
    for (int step = 0; step <= 40; ++step) {
      const auto spent = effort_to_reach(curve, kBefore, 0.03 * step);
      EXPECT_TRUE(last || !spent) << "reached more, but not less, seed " << seed;
      if (last && spent) {
        EXPECT_GE(spent->views, last->views);
        EXPECT_GE(spent->metres, last->metres);
        EXPECT_GE(spent->metres_with_profile, last->metres_with_profile);
        EXPECT_GE(spent->seconds_with_profile, last->seconds_with_profile);
      }
      last = spent;
    }
  }
}

TEST(EffortToReach, AMissionThatEndsBeforeNeverDoes) {
  const CoverageCurve whole{.coverage = {{0.2, 1, 1}, {0.5, 1, 1}, {0.9, 1, 1}},
                            .metres = {0, 10, 20},
                            .seconds = {0, 5, 9}};
  CoverageCurve dead = whole;
  dead.coverage.pop_back();
  dead.metres.pop_back();
  dead.seconds.pop_back();
  EXPECT_EQ(effort_to_reach(whole, kBefore, 0.9)->metres, 20.0);
  EXPECT_FALSE(effort_to_reach(dead, kBefore, 0.9));
  EXPECT_EQ(effort_to_reach(dead, kBefore, 0.5)->metres, 10.0);
}

TEST(EffortToReach, NeedsACurve) {
  EXPECT_THROW(effort_to_reach({}, kBefore, 0.5), BrokenInvariant);
  CoverageCurve uneven = random_curve(8);
  uneven.metres.pop_back();
  EXPECT_THROW(effort_to_reach(uneven, kBefore, 0.5), BrokenInvariant);
}

}  // namespace
}  // namespace gnbv
