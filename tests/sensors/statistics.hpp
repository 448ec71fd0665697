// Bounds on what a sample of a normal law may show.
#pragma once

#include <cmath>
#include <vector>

namespace gnbv::test {

struct Moments {
  double mean = 0.0;
  double deviation = 0.0;
  std::size_t count = 0;
};

inline Moments moments(const std::vector<double>& sample) {
  Moments m;
  m.count = sample.size();
  for (const double x : sample) m.mean += x;
  m.mean /= static_cast<double>(m.count);
  double squares = 0.0;
  for (const double x : sample) squares += (x - m.mean) * (x - m.mean);
  m.deviation = std::sqrt(squares / static_cast<double>(m.count - 1));
  return m;
}

/// Whether a sample of errors over their expected deviations is standard normal in its first two
/// moments. The mean of n has the deviation 1 / sqrt(n), and the variance sqrt(2 / n) (chi-square);
/// four of each are allowed, which 1 correct sample in 8000 misses. The seeds of the tests are
/// fixed, so that none does.
inline bool is_standard(const Moments& m) {
  const auto n = static_cast<double>(m.count);
  return std::abs(m.mean) < 4.0 / std::sqrt(n) &&
         std::abs(m.deviation * m.deviation - 1.0) < 4.0 * std::sqrt(2.0 / n);
}

}  // namespace gnbv::test
