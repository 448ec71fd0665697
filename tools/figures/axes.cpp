#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/core/text.hpp"
#include "tools/figures/figure.hpp"

namespace gnbv {
namespace {

/// As many decimals as the step has. Millions are shortened: longer numbers would leave no room.
std::string tick_text(double value, double step, double largest) {
  constexpr int kMostDecimals = 6;
  int decimals = 0;
  for (double rest = step; decimals <= kMostDecimals; rest *= 10.0, ++decimals) {
    if (std::abs(rest - std::round(rest)) <= 1e-6 * rest) break;
  }
  const bool is_millions = value != 0.0 && largest >= 1e6 && std::fmod(step, 1000.0) == 0.0;
  std::string text = decimals > kMostDecimals ? fmt::format("{:g}", value)
                     : is_millions            ? fmt::format("{:g}M", value / 1e6)
                                              : grouped(value, decimals);
  if (text.starts_with('-')) text.replace(0, 1, "\u2212");
  return text;
}

}  // namespace

double even_step(double span, int most) { return rounded_up_125(span / most); }

std::vector<AxisTick> ticks_of(double low, double high, double step) {
  std::vector<AxisTick> ticks;
  const double largest = std::max(std::abs(low), std::abs(high));
  for (double i = std::ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i) {
    const double at = i * step + 0.0;  // no -0
    ticks.push_back({at, tick_text(at, step, largest)});
  }
  return ticks;
}

Axis axis_from(std::string_view label, double low, double high, int most_steps) {
  return {.label = std::string(label),
          .low = low,
          .high = high,
          .ticks = ticks_of(low, high, even_step(high - low, most_steps))};
}

Axis axis_around(std::string_view label, double low, double high, int most_steps) {
  const double size = std::max({std::abs(low), std::abs(high), 1.0});
  if (high - low < 1e-9 * size) {  // values that are all the same lie in the middle
    low -= 0.05 * size;
    high += 0.05 * size;
  }
  const double step = even_step(high - low, most_steps);
  Axis axis{.label = std::string(label),
            .low = step * std::floor(low / step + 1e-9),
            .high = step * std::ceil(high / step - 1e-9)};
  axis.ticks = ticks_of(axis.low, axis.high, step);
  return axis;
}

Axis log_axis(std::string_view label, double low, double high) {
  const int from = static_cast<int>(std::floor(std::log10(low)));
  const int to = static_cast<int>(std::ceil(std::log10(high)));
  Axis axis{.label = std::string(label),
            .low = std::pow(10.0, from),
            .high = std::pow(10.0, to),
            .ticks = {},
            .is_log = true};
  for (int power = from; power <= to; ++power) {
    const double at = std::pow(10.0, power);
    axis.ticks.push_back({at, at < 1.0 ? fmt::format("{:.{}f}", at, -power) : grouped(at, 0)});
  }
  return axis;
}

}  // namespace gnbv
