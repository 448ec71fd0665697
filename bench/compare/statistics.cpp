#include "bench/compare/statistics.hpp"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

/// The greatest number of differences whose sign patterns are all counted.
constexpr std::size_t kExactMax = 25;

double normal_upper_tail(double z) { return 0.5 * std::erfc(z / std::sqrt(2.0)); }

std::vector<std::size_t> order_of(std::span<const double> values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  return order;
}

/// P(W <= w), or P(W >= total - w), which is the same: by the number of sign patterns a sum. Ranks
/// are counted in halves, so that shared ones are whole numbers.
double exact_lower_tail(std::span<const double> ranks, double w) {
  const auto halves = [](double rank) { return static_cast<std::size_t>(std::lround(2.0 * rank)); };
  const double total = std::accumulate(ranks.begin(), ranks.end(), 0.0);
  std::vector<double> patterns(halves(total) + 1, 0.0);  // whole numbers up to 2^25: exact
  patterns[0] = 1.0;
  for (const double rank : ranks) {
    for (std::size_t sum = patterns.size(); sum-- > halves(rank);) {
      patterns[sum] += patterns[sum - halves(rank)];
    }
  }
  const auto end = patterns.begin() + static_cast<std::ptrdiff_t>(halves(w)) + 1;
  return std::accumulate(patterns.begin(), end, 0.0) /
         std::ldexp(1.0, static_cast<int>(ranks.size()));
}

/// Sum of t^3 - t over the groups of t equal ranks.
double tie_term(std::span<const double> ranks) {
  std::vector<double> sorted(ranks.begin(), ranks.end());
  std::sort(sorted.begin(), sorted.end());
  double sum = 0.0;
  for (std::size_t i = 0, j = 0; i < sorted.size(); i = j) {
    while (j < sorted.size() && sorted[j] == sorted[i]) ++j;
    const auto t = static_cast<double>(j - i);
    sum += t * t * t - t;
  }
  return sum;
}

double normal_lower_tail(std::span<const double> ranks, double w) {
  const auto n = static_cast<double>(ranks.size());
  const double mean = n * (n + 1.0) / 4.0;
  const double variance = n * (n + 1.0) * (2.0 * n + 1.0) / 24.0 - tie_term(ranks) / 48.0;
  return normal_upper_tail((mean - w - 0.5) / std::sqrt(variance));
}

}  // namespace

double mean_of(std::span<const double> values) {
  GNBV_CHECK(!values.empty(), "a mean of nothing");
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double sample_deviation(std::span<const double> values) {
  GNBV_CHECK(values.size() > 1, "a deviation of {} values", values.size());
  const double mean = mean_of(values);
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

double student_t_quantile(double p, double degrees_of_freedom) {
  GNBV_CHECK(p > 0.0 && p < 1.0, "quantile {}", p);
  return boost::math::quantile(boost::math::students_t(degrees_of_freedom), p);
}

MeanEstimate estimate_mean(std::span<const double> values) {
  MeanEstimate estimate{.n = values.size(), .mean = mean_of(values), .half_width = {}};
  if (values.size() > 1) {
    const auto n = static_cast<double>(values.size());
    estimate.half_width =
        student_t_quantile(0.975, n - 1.0) * sample_deviation(values) / std::sqrt(n);
  }
  return estimate;
}

SignedRankTest wilcoxon_signed_rank(std::span<const double> differences) {
  std::vector<double> sizes;
  std::vector<bool> positive;
  for (const double difference : differences) {
    if (difference == 0.0) continue;
    sizes.push_back(std::abs(difference));
    positive.push_back(difference > 0.0);
  }
  SignedRankTest test;
  test.n = sizes.size();
  test.is_exact = test.n <= kExactMax;
  if (test.n == 0) return test;
  const std::vector<double> ranks = ranks_of(sizes);
  for (std::size_t i = 0; i < ranks.size(); ++i) test.w_plus += positive[i] ? ranks[i] : 0.0;
  const double total = std::accumulate(ranks.begin(), ranks.end(), 0.0);
  const double smaller = std::min(test.w_plus, total - test.w_plus);
  const double tail =
      test.is_exact ? exact_lower_tail(ranks, smaller) : normal_lower_tail(ranks, smaller);
  test.p = std::min(1.0, 2.0 * tail);
  return test;
}

double least_wilcoxon_p(std::size_t n) {
  return std::min(1.0, std::ldexp(2.0, -static_cast<int>(n)));
}

std::vector<double> holm_adjusted(std::span<const double> p) {
  std::vector<double> adjusted(p.size());
  double so_far = 0.0;
  std::size_t left = p.size();
  for (const std::size_t i : order_of(p)) {
    so_far = std::max(so_far, std::min(1.0, static_cast<double>(left--) * p[i]));
    adjusted[i] = so_far;
  }
  return adjusted;
}

std::optional<double> median_effort(std::span<const double> values) {
  GNBV_CHECK(!values.empty(), "a median of nothing");
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  const double upper = sorted[sorted.size() / 2];
  if (std::isinf(upper)) return std::nullopt;
  return 0.5 * (sorted[(sorted.size() - 1) / 2] + upper);
}

std::vector<double> ranks_of(std::span<const double> values) {
  const std::vector<std::size_t> order = order_of(values);
  std::vector<double> ranks(values.size());
  for (std::size_t i = 0, j = 0; i < order.size(); i = j) {
    while (j < order.size() && values[order[j]] == values[order[i]]) ++j;
    // places i + 1 to j, shared
    for (std::size_t k = i; k < j; ++k) ranks[order[k]] = 0.5 * static_cast<double>(i + 1 + j);
  }
  return ranks;
}

}  // namespace gnbv
