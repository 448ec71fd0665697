#include "scenarios/fields.hpp"

#include <fmt/format.h>

namespace gnbv {
namespace {

/// The two corners, as fields() of Box3 would name them.
struct Corners {
  Vec3 min;
  Vec3 max;
  Range allowed;
};

void fields(FieldVisitor& v, Corners& c) {
  v.number("min", c.min, c.allowed, "Lowest x, y and z.");
  v.number("max", c.max, c.allowed, "Highest x, y and z.");
}

}  // namespace

void FieldVisitor::box(std::string_view key, Box3& value, const Range& allowed,
                       std::string_view meaning) {
  Corners corners = {value.min(), value.max(), allowed};
  section(key, corners, meaning);
  value = Box3(corners.min, corners.max);
}

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
