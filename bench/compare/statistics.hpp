// Figures over seeds: means with intervals, paired tests, ranks.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace gnbv {

/// Requires a value.
double mean_of(std::span<const double> values);

/// A mean and how far the true one may be from it.
struct MeanEstimate {
  std::size_t n = 0;
  double mean = 0.0;
  std::optional<double> half_width =
      {};  // of the 95 % interval (Student 1908); none with one value
};

/// Requires a value.
MeanEstimate estimate_mean(std::span<const double> values);

/// The exact test takes n^3 steps; beyond so many differences that are not 0 it is the normal
/// approximation, whose p is off by less than 1 % of it around 0.05.
constexpr std::size_t kMostExact = 200;

/// Wilcoxon's signed-rank test (Wilcoxon 1945) that differences are symmetric about 0. They may be
/// infinite: the largest of all, of equal size.
struct SignedRankTest {
  std::size_t n = 0;    // differences that are not 0; the others are dropped
  double w_plus = 0.0;  // sum of the ranks of positive differences; equal sizes share their ranks
  double p = 1.0;       // two-sided, up to kMostExact exact: over all 2^n signs

  /// Whether positive differences have more than half of all ranks.
  bool is_above() const { return w_plus > 0.25 * static_cast<double>(n * (n + 1)); }
};

SignedRankTest wilcoxon_signed_rank(std::span<const double> differences);

/// The smallest p that `n` differences can have: all of one sign, none 0, none equal in size.
double least_wilcoxon_p(std::size_t n);

/// The middle of values that are infinite where something was not reached; nothing when it is
/// infinite, too. Unlike a mean over those that reached it, it does not get better when slow ones
/// fail. Requires a value.
std::optional<double> median_effort(std::span<const double> values);

/// Share of the values below that one; those equal to it count half. Requires a value.
double share_below(std::span<const double> values, double figure);

/// Of all ways to draw one value of each group, the share in which each is above the next one's:
/// how often single draws come in this order. Requires groups with values.
double share_descending(std::span<const std::vector<double>> groups);

/// Holm's step-down adjustment (Holm 1979): p values of one family, in their order.
std::vector<double> holm_adjusted(std::span<const double> p);

/// Ranks from 1 for the smallest; equal values share the mean of theirs.
std::vector<double> ranks_of(std::span<const double> values);

}  // namespace gnbv
