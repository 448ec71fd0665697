#include "bench/compare/statistics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/core/rng.hpp"

namespace gnbv {
namespace {

/// P of a rank sum at least as far from its centre, by laying out all sign patterns.
double brute_force_p(const std::vector<double>& differences) {
  std::vector<double> sizes;
  double w = 0.0;
  for (const double d : differences) {
    if (d != 0.0) sizes.push_back(std::abs(d));
  }
  const std::vector<double> ranks = ranks_of(sizes);
  double total = 0.0;
  for (std::size_t i = 0, k = 0; i < differences.size(); ++i) {
    if (differences[i] == 0.0) continue;
    total += ranks[k];
    w += differences[i] > 0.0 ? ranks[k] : 0.0;
    ++k;
  }
  unsigned as_far = 0;
  for (unsigned signs = 0; signs < (1U << sizes.size()); ++signs) {
    double sum = 0.0;
    for (std::size_t i = 0; i < sizes.size(); ++i) sum += (signs >> i & 1U) != 0 ? ranks[i] : 0.0;
    if (std::abs(sum - total / 2) >= std::abs(w - total / 2)) ++as_far;
  }
  return as_far / std::ldexp(1.0, static_cast<int>(sizes.size()));
}

std::vector<double> normal_values(std::size_t n, std::uint64_t seed, double mean = 0.0) {
  std::vector<double> values(n);
  for (std::size_t i = 0; i < n; ++i) {
    values[i] = mean + standard_normal({seed, Stream::bench, 0, i});
  }
  return values;
}

TEST(MeanEstimate, IsTheTextbooks) {
  const std::vector<double> values = {1.0, 2.0, 3.0, 4.0, 5.0};
  const MeanEstimate estimate = estimate_mean(values);
  EXPECT_EQ(estimate.n, 5U);
  EXPECT_DOUBLE_EQ(estimate.mean, 3.0);
  EXPECT_NEAR(*estimate.half_width, 2.776445 * std::sqrt(0.5), 1e-6);
  EXPECT_FALSE(estimate_mean(std::vector<double>{7.0}).half_width.has_value());
}

// 4,000 samples: the share that contains the truth has a standard error of 0.35 points.
TEST(MeanEstimate, ContainsTheTruthIn95OfHundredSamples) {
  for (const std::size_t n : {2U, 5U, 12U}) {
    int hits = 0;
    for (std::uint64_t seed = 0; seed < 4000; ++seed) {
      const MeanEstimate e = estimate_mean(normal_values(n, seed, 3.0));
      hits += std::abs(e.mean - 3.0) <= *e.half_width ? 1 : 0;
    }
    EXPECT_NEAR(hits / 4000.0, 0.95, 0.012) << n;
  }
}

TEST(Wilcoxon, ExactPIsThatOfAllSignPatternsTiesAndZerosIncluded) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const std::size_t n = 1 + seed % 10;
    std::vector<double> differences = normal_values(n, seed, 0.4);
    // every other sample is rounded, so that sizes are equal and some differences 0
    if (seed % 2 == 1) {
      for (double& d : differences) d = std::round(2.0 * d);
    }
    EXPECT_NEAR(wilcoxon_signed_rank(differences).p, brute_force_p(differences), 1e-12) << seed;
  }
}

// Wilcoxon and Wilcox 1964: the greatest smaller rank sum with two-sided p <= 0.05.
TEST(Wilcoxon, CriticalValuesAreThoseOfThePublishedTable) {
  for (const auto& [n, critical] :
       {std::pair(6, 0), std::pair(7, 2), std::pair(8, 3), std::pair(9, 5), std::pair(10, 8),
        std::pair(12, 13), std::pair(15, 25), std::pair(20, 52), std::pair(25, 89),
        std::pair(30, 137), std::pair(40, 264)}) {
    // negative where the greatest ranks that still fit into the wanted sum are
    const auto p_of_sum = [](int most, int sum) {
      std::vector<double> differences;
      for (int rank = most; rank >= 1; --rank) {
        const bool negative = rank <= sum;
        if (negative) sum -= rank;
        differences.push_back(negative ? -rank : rank);
      }
      return wilcoxon_signed_rank(differences).p;
    };
    EXPECT_LE(p_of_sum(n, critical), 0.05) << n;
    EXPECT_GT(p_of_sum(n, critical + 1), 0.05) << n;
  }
}

TEST(Wilcoxon, ItsLeastPIsThatOfDifferencesOfOneSign) {
  std::vector<double> differences;
  for (std::size_t n = 0; n <= 30; ++n) {
    const SignedRankTest test = wilcoxon_signed_rank(differences);
    EXPECT_EQ(test.n, n);
    EXPECT_DOUBLE_EQ(test.p, least_wilcoxon_p(n));
    differences.push_back(static_cast<double>(n + 1));
  }
  EXPECT_EQ(least_wilcoxon_p(5), 0.0625);
  EXPECT_EQ(wilcoxon_signed_rank(std::vector<double>{0.0, 0.0}).n, 0U);
}

/// scipy.stats.wilcoxon of SciPy 1.17: exact up to kMostExact differences, beyond that
/// mode='approx'.
TEST(Wilcoxon, OfManyDifferencesIsSciPys) {
  const auto p_of = [](int n, int negative, double step) {
    std::vector<double> differences;
    for (int i = 1; i <= n; ++i) {
      const double size = std::nearbyint(i / step);  // halves to even, as NumPy's round
      differences.push_back((i * 7919) % 10 >= negative ? size : -size);
    }
    return wilcoxon_signed_rank(differences).p;
  };
  EXPECT_NEAR(p_of(200, 4, 1.0), 0.030632721723134138, 1e-12);
  EXPECT_NEAR(p_of(300, 3, 1.0), 6.811256036093387e-09, 1e-20);
  EXPECT_NEAR(p_of(300, 4, 7.0), 0.005932151844785626, 1e-12);  // shared ranks, some 0
}

TEST(Wilcoxon, RefusesATrueHypothesisAsRarelyAsItSays) {
  int refused = 0;
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    refused += wilcoxon_signed_rank(normal_values(8, seed)).p <= 0.05 ? 1 : 0;
  }
  // exact test of n = 8: p <= 0.05 has probability 10/256 = 0.039, standard error 0.003
  EXPECT_NEAR(refused / 4000.0, 10.0 / 256.0, 0.01);
}

// What is infinite is the largest of all: any finite stand-in that is large enough gives the same.
TEST(Wilcoxon, InfiniteDifferencesAreTheLargest) {
  const double never = std::numeric_limits<double>::infinity();
  for (const auto& differences : {std::vector{never, 3.0, -1.0, never, 2.5, 4.0},
                                  std::vector{-never, 3.0, 1.0, never, 2.5}}) {
    std::vector<double> finite = differences;
    for (double& d : finite) d = std::clamp(d, -1e6, 1e6);
    EXPECT_EQ(wilcoxon_signed_rank(differences).p, wilcoxon_signed_rank(finite).p);
    EXPECT_EQ(wilcoxon_signed_rank(differences).w_plus, wilcoxon_signed_rank(finite).w_plus);
    EXPECT_DOUBLE_EQ(wilcoxon_signed_rank(differences).p, brute_force_p(differences));
  }
}

TEST(MedianEffort, IsTheMiddleWhateverTheFailuresWouldHaveCost) {
  const double never = std::numeric_limits<double>::infinity();
  const auto median = [](std::vector<double> values) { return median_effort(values); };
  EXPECT_EQ(median({7.0}), 7.0);
  EXPECT_EQ(median({never, 1.0, 5.0}), 5.0);
  EXPECT_EQ(median({4.0, 1.0, never, 2.0}), 3.0);
  EXPECT_EQ(median({4.0, never, never}), std::nullopt);
  EXPECT_EQ(median({4.0, 1.0, never, never}), std::nullopt);  // the upper of the middle two
  EXPECT_EQ(median({never}), std::nullopt);
}

TEST(Holm, StepsDownAndNeverDecreases) {
  // ordered: 0.01 x 4, 0.013 x 3, 0.03 x 2, 0.04 x 1 -> not below the one before
  const std::vector<double> adjusted = holm_adjusted(std::vector<double>{0.03, 0.01, 0.04, 0.013});
  EXPECT_DOUBLE_EQ(adjusted[1], 0.04);
  EXPECT_DOUBLE_EQ(adjusted[3], 0.04);
  EXPECT_DOUBLE_EQ(adjusted[0], 0.06);
  EXPECT_DOUBLE_EQ(adjusted[2], 0.06);
  EXPECT_EQ(holm_adjusted(std::vector<double>{0.7, 0.8}), (std::vector<double>{1.0, 1.0}));
  EXPECT_EQ(holm_adjusted(std::vector<double>{0.2}), (std::vector<double>{0.2}));
}

TEST(ShareDescending, CountsTheDrawsThatComeInThatOrder) {
  const std::vector<std::vector<double>> groups = {
      normal_values(7, 1), normal_values(5, 2), normal_values(6, 3), {-2.0, -2.0, 0.5}};
  double in_order = 0.0;
  for (const double a : groups[0]) {
    for (const double b : groups[1]) {
      for (const double c : groups[2]) {
        for (const double d : groups[3]) in_order += a > b && b > c && c > d ? 1.0 : 0.0;
      }
    }
  }
  ASSERT_GT(in_order, 0.0);
  EXPECT_NEAR(share_descending(groups), in_order / (7.0 * 5.0 * 6.0 * 3.0), 1e-12);
  EXPECT_EQ(share_descending(std::vector<std::vector<double>>{{1.0, 2.0}, {1.0, 2.0}}), 0.25);
}

TEST(ShareBelow, EqualValuesCountHalf) {
  const std::vector<double> values = {1.0, 2.0, 2.0, 4.0};
  EXPECT_EQ(share_below(values, 0.5), 0.0);
  EXPECT_EQ(share_below(values, 2.0), 0.5);
  EXPECT_EQ(share_below(values, 3.0), 0.75);
  EXPECT_EQ(share_below(values, 9.0), 1.0);
}

TEST(Ranks, EqualValuesShareTheirs) {
  EXPECT_EQ(ranks_of(std::vector<double>{3.0, 1.0, 3.0, 2.0}),
            (std::vector<double>{3.5, 1.0, 3.5, 2.0}));
  EXPECT_EQ(ranks_of(std::vector<double>{5.0, 5.0, 5.0}), (std::vector<double>{2.0, 2.0, 2.0}));
}

}  // namespace
}  // namespace gnbv
