// Round numbers for people: 1, 2 or 5 times a power of ten.
#pragma once

#include <cmath>

namespace gnbv {

/// The smallest round number that is not below `value` > 0, but for what rounding made of it.
inline double round_up(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value) + 1e-9));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (value <= (factor + 1e-9) * power) return factor * power;
  }
  return 10.0 * power;
}

/// The largest round number that is not above `value` > 0.
inline double round_down(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value) + 1e-9));
  for (const double factor : {5.0, 2.0}) {
    if (value >= (factor - 1e-9) * power) return factor * power;
  }
  return power;
}

}  // namespace gnbv
