// Axes: ranges, even steps, and what their ticks say.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gnbv {

struct AxisTick {
  double at = 0.0;
  std::string text;
};

struct Axis {
  std::string label = {};
  double low = 0.0;
  double high = 1.0;
  std::vector<AxisTick> ticks = {};
  bool is_log = false;
};

/// 1, 2 or 5 times a power of ten, of which `span` holds at most so many. Requires span > 0.
double even_step(double span, int most = 5);

/// From `low` to `high` as they are, with ticks at the whole multiples of an even step. Requires
/// low < high.
Axis axis_from(std::string_view label, double low, double high, int most_steps = 5);

/// Around both, on whole even steps. Requires low <= high.
Axis axis_around(std::string_view label, double low, double high, int most_steps = 5);

/// A logarithmic axis on whole powers of ten around both. Requires 0 < low < high.
Axis log_axis(std::string_view label, double low, double high);

/// Ticks at the whole multiples of `step` within the axis: thousands apart, a true minus, as many
/// decimals as the step has.
std::vector<AxisTick> ticks_of(double low, double high, double step);

}  // namespace gnbv
