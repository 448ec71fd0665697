#include "bench/compare/statistics.hpp"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

std::vector<std::size_t> order_of(std::span<const double> values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  return order;
}

/// P(W <= w), or P(W >= total - w), which is the same: the probability of each sum, a rank after
/// the other, its sign either way. Ranks are counted in halves, so that shared ones are whole.
double lower_tail(std::span<const double> ranks, double w) {
  const auto halves = [](double rank) { return static_cast<std::size_t>(std::lround(2.0 * rank)); };
  const double total = std::accumulate(ranks.begin(), ranks.end(), 0.0);
  std::vector<double> p(halves(total) + 1, 0.0);
  p[0] = 1.0;
  for (const double rank : ranks) {
    for (std::size_t sum = p.size(); sum-- > 0;) {
      p[sum] = 0.5 * (p[sum] + (sum < halves(rank) ? 0.0 : p[sum - halves(rank)]));
    }
  }
  return std::accumulate(p.begin(), p.begin() + static_cast<std::ptrdiff_t>(halves(w)) + 1, 0.0);
}

}  // namespace

double mean_of(std::span<const double> values) {
  GNBV_CHECK(!values.empty(), "a mean of nothing");
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

MeanEstimate estimate_mean(std::span<const double> values) {
  MeanEstimate estimate{.n = values.size(), .mean = mean_of(values)};
  if (values.size() < 2) return estimate;
  const auto n = static_cast<double>(values.size());
  double squares = 0.0;
  for (const double value : values) squares += (value - estimate.mean) * (value - estimate.mean);
  const double deviation = std::sqrt(squares / (n - 1.0));
  const boost::math::students_t student(n - 1.0);
  estimate.half_width = boost::math::quantile(student, 0.975) * deviation / std::sqrt(n);
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
  if (test.n == 0) return test;
  const std::vector<double> ranks = ranks_of(sizes);
  for (std::size_t i = 0; i < ranks.size(); ++i) test.w_plus += positive[i] ? ranks[i] : 0.0;
  const double total = std::accumulate(ranks.begin(), ranks.end(), 0.0);
  const double smaller = std::min(test.w_plus, total - test.w_plus);
  if (test.n > kMostExact) {
    // the sum's variance is that of its n signs, whether ranks are shared or not
    const double squares = std::inner_product(ranks.begin(), ranks.end(), ranks.begin(), 0.0);
    test.p = std::erfc((0.5 * total - smaller) / std::sqrt(0.5 * squares));
    return test;
  }
  test.p = std::min(1.0, 2.0 * lower_tail(ranks, smaller));
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

double share_below(std::span<const double> values, double figure) {
  double below = 0.0;
  for (const double value : values) below += value < figure ? 1.0 : value == figure ? 0.5 : 0.0;
  return below / static_cast<double>(values.size());
}

double share_descending(std::span<const std::vector<double>> groups) {
  // of the draws so far, by their last value, the share that is in order
  std::vector<std::pair<double, double>> last = {{std::numeric_limits<double>::infinity(), 1.0}};
  for (const std::vector<double>& group : groups) {
    std::vector<std::pair<double, double>> next;
    for (const double value : group) {
      double share = 0.0;
      for (const auto& [above, so_far] : last) share += above > value ? so_far : 0.0;
      next.emplace_back(value, share / static_cast<double>(group.size()));
    }
    last = std::move(next);
  }
  double share = 0.0;
  for (const auto& [value, so_far] : last) share += so_far;
  return share;
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
