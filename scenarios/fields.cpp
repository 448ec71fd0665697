#include "scenarios/fields.hpp"

#include <fmt/format.h>

namespace gnbv {

bool contains(const Range& range, double value) {
  const bool is_above = range.is_min_open ? value > range.min : value >= range.min;
  const bool is_below = range.is_max_open ? value < range.max : value <= range.max;
  return is_above && is_below;
}

std::string text_of(const Range& range) {
  return fmt::format("{} {}{} {}", range.is_min_open ? "above" : "from", range.min,
                     range.is_max_open ? ", below" : (range.is_min_open ? ", up to" : " to"),
                     range.max);
}

}  // namespace gnbv
