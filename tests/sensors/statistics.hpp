// Bounds on what a sample of a normal law may show.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace gnbv::test {

/// Whether a sample of errors over their expected deviations is standard normal in its first two
/// moments. The mean of n has the deviation 1 / sqrt(n), and the variance sqrt(2 / n) (chi-square);
/// four of each are allowed, which 1 correct sample in 8000 misses. The seeds of the tests are
/// fixed, so that none does.
inline testing::AssertionResult is_standard(const std::vector<double>& sample) {
  const auto n = static_cast<double>(sample.size());
  double mean = 0.0, squares = 0.0;
  for (const double x : sample) mean += x / n;
  for (const double x : sample) squares += (x - mean) * (x - mean);
  const double variance = squares / (n - 1.0);
  if (std::abs(mean) < 4.0 / std::sqrt(n) && std::abs(variance - 1.0) < 4.0 * std::sqrt(2.0 / n)) {
    return testing::AssertionSuccess();
  }
  return testing::AssertionFailure() << "mean " << mean << ", variance " << variance;
}

/// Share of the finite readings of two frames or scans that agree to the bit.
inline double agreement(const std::vector<float>& a, const std::vector<float>& b) {
  double both = 0.0, same = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!std::isfinite(a[i]) || !std::isfinite(b[i])) continue;
    both += 1.0;
    same += a[i] == b[i] ? 1.0 : 0.0;
  }
  return same / both;
}

}  // namespace gnbv::test
