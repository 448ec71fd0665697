#include "tools/plots/script_parts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "tools/plots/gnuplot.hpp"

namespace gnbv {
namespace {

constexpr std::string_view kPhaseColour = "#dcebf5";
constexpr double kLeft = 0.115;  // edges of all panels, as shares of the width
constexpr double kRight = 0.975;
constexpr double kTextLine = 50.0;  // of a picture as wide as PlotSize is at first, in pixels

}  // namespace

int panels_height_px(std::size_t count) { return count < 3 ? 1150 : 1450; }

std::string data_block(std::string_view name, const std::vector<std::vector<double>>& rows) {
  std::string text = fmt::format("${} << EOD\n", name);
  for (const auto& row : rows) {
    fmt::format_to(std::back_inserter(text), "{}\n", fmt::join(row, " "));
  }
  return text + "EOD\n";
}

std::string shaded_phases(const std::vector<Phase>& phases) {
  std::string text = "unset object\n";
  for (const Phase& phase : phases) {
    text += fmt::format(
        "set object rectangle from {},graph 0 to {},graph 1 behind fc rgb '{}' fs solid noborder\n",
        phase.first - 0.5, phase.last + 0.5, kPhaseColour);
  }
  return text;
}

std::string key_of_phases(const std::vector<Phase>& phases) {
  if (phases.empty()) return "";
  return fmt::format(", keyentry with boxes fs solid noborder fc rgb '{}' title 'frontier views'",
                     kPhaseColour);
}

std::string y_axis(double low, double high) {
  // values that are all the same lie in the middle of an axis around them
  const double size = std::max({std::abs(low), std::abs(high), 1.0});
  if (high - low < 1e-9 * size) {
    low -= 0.05 * size;
    high += 0.05 * size;
  }
  const double span = high - low;
  const double power = std::pow(10.0, std::floor(std::log10(span / 4.0)));
  double step = 10.0 * power;
  for (const double factor : {5.0, 2.0, 1.0}) {
    if (span / (factor * power) <= 5.0) step = factor * power;
  }
  return fmt::format("set yrange [{:.12g}:{:.12g}]\nset ytics {:.12g}\n",
                     step * std::floor(low / step), step * std::ceil(high / step), step);
}

Panels::Panels(std::size_t count, std::string_view title, std::string_view x_label)
    : count_(count), title_(title), x_label_(x_label) {}

std::string Panels::next(std::string_view heading) {
  const auto n = static_cast<double>(count_);
  // a line of letters, as a share of a picture that has its natural height
  const double text_line = kTextLine / panels_height_px(count_);
  const double bottom = 3.1 * text_line;
  const double heading_height = 1.9 * text_line;
  const double height = (1.0 - 1.5 * text_line - bottom) / n - heading_height;
  const double top = 1.0 - 1.5 * text_line - heading_height -
                     static_cast<double>(drawn_) * (height + heading_height);
  const bool is_last = drawn_ + 1 == count_;
  std::string text;
  if (drawn_ == 0) {
    text += fmt::format("set multiplot\nset lmargin at screen {}\nset rmargin at screen {}\n",
                        kLeft, kRight);
    text += fmt::format("set label 1 {} at screen 0.02,{:.4f} left textcolor rgb '#262c36'\n",
                        gnuplot_text(title_), 1.0 - text_line);
  } else {
    text += "unset label 1\n";
  }
  text += fmt::format("set tmargin at screen {:.4f}\nset bmargin at screen {:.4f}\n", top,
                      top - height);
  const double heading_middle = top + 0.75 * text_line;
  text += fmt::format("set label 2 {} at screen {},{:.4f} left textcolor rgb '#5c6470'\n",
                      gnuplot_text(heading), kLeft, heading_middle);
  text += fmt::format("set key at screen {},{:.4f} right center horizontal maxrows 1 width -2\n",
                      kRight, heading_middle);
  text += is_last ? fmt::format("set format x '%g'\nset xlabel {} textcolor rgb '#262c36'\n",
                                gnuplot_text(x_label_))
                  : "set format x ''\nunset xlabel\n";
  drawn_ += 1;
  return text;
}

}  // namespace gnbv
