#include "sim/core/grouped.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gnbv {
namespace {

std::string with_commas(std::string digits) {
  const std::size_t point = std::min(digits.find('.'), digits.size());
  for (std::size_t i = point; i > 3; i -= 3) digits.insert(i - 3, ",");
  return digits;
}

}  // namespace

std::string grouped(std::size_t count) { return with_commas(std::to_string(count)); }

std::string grouped(double value, int decimals) {
  const std::string digits = fmt::format("{:.{}f}", std::abs(value), decimals);
  const bool is_zero = digits.find_first_of("123456789") == std::string::npos;
  return (value < 0.0 && !is_zero ? "-" : "") + with_commas(digits);
}

}  // namespace gnbv
