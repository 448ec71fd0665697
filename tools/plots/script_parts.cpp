#include "tools/plots/script_parts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "tools/plots/gnuplot.hpp"
#include "tools/run_files/words.hpp"

namespace gnbv {
namespace {

constexpr std::string_view kPhaseColour = "#dcebf5";
constexpr double kLeft = 0.135;  // edges of all panels, as shares of the width
constexpr double kRight = 0.975;
constexpr double kTextLine = 54.0;  // of a picture as wide as PlotSize is at first, in pixels

}  // namespace

std::string_view effort_label(Effort effort) {
  switch (effort) {
    case Effort::views:
      return "views";
    case Effort::metres:
      return "straight path from the first view on (m)";
    case Effort::seconds:
      return "time from the first view on (s)";
  }
  return "";
}

std::string_view effort_name(Effort effort) {
  return effort == Effort::views ? "views" : effort == Effort::metres ? "metres" : "seconds";
}

int panels_height_px(std::size_t count) { return count < 3 ? 1150 : count < 5 ? 1450 : 1700; }

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
        phase.first + 0.5, phase.last + 1.5, kPhaseColour);
  }
  return text;
}

std::string key_row(const std::vector<KeyEntry>& key, double screen_y) {
  constexpr double kLetter = 0.0172;  // shares of the width, with some room to spare
  constexpr double kSquare = 0.036;
  const auto width_of = [](const KeyEntry& entry) {
    return kLetter * static_cast<double>(entry.text.size()) + 2.0 * kSquare;
  };
  double x = kRight + kSquare - 0.01;  // the last word may be one of wide letters
  for (const KeyEntry& entry : key) x -= width_of(entry);
  std::string text;
  int label = 10;
  for (const KeyEntry& entry : key) {
    text += fmt::format("set label {} '{}' at screen {:.4f},{:.4f} left textcolor rgb '{}'\n",
                        label, entry.mark, x, screen_y, entry.colour);
    text += fmt::format("set label {} {} at screen {:.4f},{:.4f} left textcolor rgb '#262c36'\n",
                        label + 1, gnuplot_text(entry.text), x + kSquare, screen_y);
    x += width_of(entry);
    label += 2;
  }
  return text;
}

std::vector<KeyEntry> key_of_phases(const std::vector<Phase>& phases) {
  if (phases.empty()) return {};
  return {{kPhaseColour, "frontier views"}};
}

double even_step(double span, int most) {
  const double power = std::pow(10.0, std::floor(std::log10(span / (most - 1))));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (span / (factor * power) <= most) return factor * power;
  }
  return 10.0 * power;
}

Axis axis_around(double low, double high, int most_steps) {
  // values that are all the same lie in the middle of an axis around them
  const double size = std::max({std::abs(low), std::abs(high), 1.0});
  if (high - low < 1e-9 * size) {
    low -= 0.05 * size;
    high += 0.05 * size;
  }
  const double step = even_step(high - low, most_steps);
  return {step * std::floor(low / step), step * std::ceil(high / step), step};
}

std::string x_tics(double low, double high, double step) {
  if (high < 1000.0) return fmt::format("set xtics {:g}\n", step);
  std::string tics;
  for (double i = std::ceil(low / step); i * step <= high; ++i) {
    const auto at = static_cast<std::size_t>(std::lround(i * step));
    tics += fmt::format("{}'{}' {}", tics.empty() ? "" : ", ", grouped(at), at);
  }
  return fmt::format("set xtics ({})\n", tics);
}

namespace {

/// All marks with as many decimals as the step has: 94.0 beside 93.9.
std::string format_of(const Axis& axis) {
  constexpr int kMost = 6;  // beyond that, powers of ten say it
  const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(axis.step) + 1e-9)));
  const double largest = std::max(std::abs(axis.low), std::abs(axis.high));
  return decimals > kMost || largest >= 1e6 ? "% h" : fmt::format("% .{}f", decimals);
}

}  // namespace

std::string y_axis(double low, double high, int most_steps) {
  const Axis axis = axis_around(low, high, most_steps);
  // longer numbers would be cut off at the left: 200k
  const bool is_in_thousands = high >= 10'000.0 && std::fmod(axis.step, 1000.0) == 0.0;
  const std::string format = !is_in_thousands ? format_of(axis) : high < 1e6 ? "%.0s%c" : "%.1s%c";
  return fmt::format("set yrange [{:.12g}:{:.12g}]\nset ytics {:.12g}\nset format y '{}'\n",
                     axis.low, axis.high, axis.step, format);
}

std::string tight_y_axis(double low, double high, int most_steps) {
  Axis axis;
  double from = 0.0;
  double to = 0.0;
  // a step that leaves one mark, or none, says nothing: a finer one (of equal values none helps)
  for (const int steps : {most_steps, most_steps + 1, 2 * most_steps}) {
    axis = axis_around(low, high, steps);
    const double room = 0.04 * std::max(high - low, axis.step);
    from = std::max(axis.low, low - room);
    to = std::min(axis.high, high + room);
    if (std::floor(to / axis.step) - std::ceil(from / axis.step) >= 1.0) break;
  }
  return fmt::format("set yrange [{:.12g}:{:.12g}]\nset ytics {:.12g}\nset format y '{}'\n", from,
                     to, axis.step, format_of(axis));
}

std::string common_scenario(std::span<const RunGroup> groups) {
  const std::string& first = groups.front().runs.front()->figures->scenario;
  const bool is_common = std::all_of(groups.begin(), groups.end(), [&](const RunGroup& group) {
    return group.runs.front()->figures->scenario == first;
  });
  const std::string name = human_name(first);
  const bool is_said = std::any_of(groups.begin(), groups.end(), [&](const RunGroup& group) {
    return group.label.find(name) != std::string::npos;
  });
  return is_common && !is_said ? name : "";
}

std::string title_at_right(std::string_view title, int height_px) {
  if (title.empty()) return "";
  return fmt::format("set label 1 {} at screen 0.985,{:.4f} right textcolor rgb '#262c36'\n",
                     gnuplot_text(title), 1.0 - 0.5 * kKeyLine_px / height_px);
}

int end_mark(std::size_t slot) {
  constexpr std::array<int, 6> kMarks = {7, 5, 9, 11, 13, 15};
  return kMarks[slot % kMarks.size()];
}

std::string end_points(std::string_view block, std::size_t slot) {
  return fmt::format(
      "${0} using 1:2 with points pt {1} ps 0.75 lc rgb 'white' notitle, "
      "${0} using 1:2 with points pt {1} ps 0.5 lc rgb '{2}' notitle, ",
      block, end_mark(slot), palette_colour(slot));
}

int height_with_key_px(std::size_t entries) {
  return kOnePanel_px + kKeyLine_px * static_cast<int>(entries);
}

std::string key_above(std::size_t entries) {
  const int key_px = kKeyLine_px * (static_cast<int>(entries) + 1);
  return fmt::format(
      "set key at screen 0.1,0.99 left top vertical maxcols 1\nset tmargin at screen {:.4f}\n",
      1.0 - static_cast<double>(key_px) / height_with_key_px(entries));
}

Panels::Panels(std::size_t count, std::string_view title, std::string_view x_label,
               const std::array<double, 2>& x_range)
    : count_(count), title_(title), x_label_(x_label), x_range_(x_range) {}

std::string Panels::next(std::string_view heading, const std::vector<KeyEntry>& key) {
  const auto n = static_cast<double>(count_);
  // a line of letters, as a share of a picture that has its natural height
  const double text_line = kTextLine / panels_height_px(count_);
  const double bottom = 2.9 * text_line;
  const double heading_height = 1.9 * text_line;
  const double height = (1.0 - 1.5 * text_line - bottom) / n - heading_height;
  const double top = 1.0 - 1.5 * text_line - heading_height -
                     static_cast<double>(drawn_) * (height + heading_height);
  const bool is_last = drawn_ + 1 == count_;
  std::string text;
  if (drawn_ == 0) {
    text += fmt::format(
        "set multiplot\nunset key\nunset xlabel\nset lmargin at screen {}\nset rmargin at screen "
        "{}\nset xrange [{}:{}]\n",
        kLeft, kRight, x_range_[0], x_range_[1]);
    text += fmt::format("set label 1 {} at screen 0.02,{:.4f} left textcolor rgb '#262c36'\n",
                        gnuplot_text(title_), 1.0 - text_line);
  } else {
    text += "unset label\n";
  }
  text += fmt::format("set tmargin at screen {:.4f}\nset bmargin at screen {:.4f}\n", top,
                      top - height);
  const double heading_middle = top + 0.75 * text_line;
  text += fmt::format("set label 2 {} at screen {},{:.4f} left textcolor rgb '#5c6470'\n",
                      gnuplot_text(heading), kLeft, heading_middle);
  text += key_row(key, heading_middle);
  const double step = even_step(std::max(x_range_[1] - x_range_[0], 1.0));
  text += is_last ? "set format x '%g'\n" + x_tics(x_range_[0], x_range_[1], step)
                  : fmt::format("set format x ''\nset xtics {:g}\n", step);
  if (is_last) {
    text +=
        fmt::format("set label 3 {} at graph 0.5,screen {:.4f} center textcolor rgb '#262c36'\n",
                    gnuplot_text(x_label_), 0.6 * text_line);
  }
  drawn_ += 1;
  return text;
}

}  // namespace gnbv
