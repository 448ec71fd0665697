#include "tools/plots/script_parts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "tools/plots/gnuplot.hpp"
#include "tools/run/words.hpp"

namespace gnbv {
namespace {

constexpr std::string_view kPhaseColour = "#dcebf5";
constexpr double kLeft = 0.165;  // edges of all panels, as shares of the width
constexpr double kRight = 0.975;
constexpr double kTextLine_px = 54.0;

}  // namespace

std::string_view method_dashes(std::size_t slot) {
  constexpr std::array<std::string_view, 5> kDashes = {"1", "(16,10)", "(6,8)", "(2,8)",
                                                       "(16,8,2,8)"};
  return kDashes[slot % kDashes.size()];
}

std::string_view effort_label(Effort effort) {
  switch (effort) {
    case Effort::views:
      return "views";
    case Effort::metres:
      return "path since the first view, straight legs (m)";
    case Effort::seconds:
      return "time since the first view (s)";
  }
  return "";
}

std::string end_label(Effort effort, int percent) {
  const std::string_view of = effort == Effort::views    ? "views"
                              : effort == Effort::metres ? "the path, straight legs (m)"
                                                         : "the time since the first view (s)";
  return fmt::format("last {} % of {}", percent, of);
}

std::string_view effort_name(Effort effort) {
  return effort == Effort::views ? "views" : effort == Effort::metres ? "metres" : "seconds";
}

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

std::vector<KeyEntry> key_of_phases(const std::vector<Phase>& phases) {
  if (phases.empty()) return {};
  return {{.colour = kPhaseColour, .text = "frontier views"}};
}

double even_step(double span, int most) {
  const double power = std::pow(10.0, std::floor(std::log10(span / (most - 1))));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (span / (factor * power) <= most) return factor * power;
  }
  return 10.0 * power;
}

namespace {

double size_of(double low, double high) { return std::max({std::abs(low), std::abs(high), 1.0}); }
bool are_same(double low, double high) { return high - low < 1e-9 * size_of(low, high); }

}  // namespace

Axis axis_around(double low, double high, int most_steps) {
  // values that are all the same lie in the middle of an axis around them
  if (are_same(low, high)) {
    const double room = 0.05 * size_of(low, high);
    low -= room;
    high += room;
  }
  const double step = even_step(high - low, most_steps);
  return {step * std::floor(low / step), step * std::ceil(high / step), step};
}

Axis close_axis(double low, double high, int most_steps) {
  if (are_same(low, high)) return axis_around(low, high, most_steps);
  const double power = std::pow(10.0, std::floor(std::log10((high - low) / most_steps)));
  Axis best;
  for (const double factor : {50.0, 25.0, 20.0, 10.0, 5.0, 2.5, 2.0, 1.0}) {
    const double step = factor * power;
    const Axis axis{step * std::floor(low / step), step * std::ceil(high / step), step};
    const double steps = std::round((axis.high - axis.low) / step);
    const bool is_closer = axis.high - axis.low < (1.0 - 1e-9) * (best.high - best.low);
    if (steps < 2.0 || steps > most_steps || (best.step > 0.0 && !is_closer)) continue;
    best = axis;
  }
  return best.step > 0.0 ? best : axis_around(low, high, most_steps);
}

namespace {

/// Of an axis, each with its text: "'1,000' 1000, '1,500' 1500".
std::string grouped_tics(double low, double high, double step) {
  std::string tics;
  for (double i = std::ceil(low / step - 1e-9) + 0.0; i * step <= high + 1e-9 * step; ++i) {
    std::string mark = grouped(i * step, 0);
    if (mark.starts_with('-')) mark.replace(0, 1, "\u2212");
    tics += fmt::format("{}'{}' {:.12g}", tics.empty() ? "" : ", ", mark, i * step);
  }
  return tics;
}

/// All marks with as many decimals as the step has: 94.0 beside 93.9.
std::string format_of(const Axis& axis) {
  constexpr int kMost = 6;  // beyond that, powers of ten say it
  int decimals = 0;
  for (double step = axis.step;
       decimals <= kMost && std::abs(step - std::round(step)) > 1e-6 * step; step *= 10.0) {
    ++decimals;
  }
  const double largest = std::max(std::abs(axis.low), std::abs(axis.high));
  return decimals > kMost || largest >= 1e6 ? "% h" : fmt::format("% .{}f", decimals);
}

}  // namespace

std::string x_tics(double low, double high, double step) {
  if (high < 1000.0) return fmt::format("set xtics {:g}\n", step);
  return fmt::format("set xtics ({})\n", grouped_tics(low, high, step));
}

std::string axis_settings(const Axis& axis) {
  const double largest = std::max(std::abs(axis.low), std::abs(axis.high));
  const bool is_grouped = largest >= 1000.0 && largest < 1e6 && axis.step >= 1.0;
  // longer numbers would be cut off at the left: 1.8M
  const bool is_long = largest >= 1e6 && std::fmod(axis.step, 1000.0) == 0.0;
  const std::string tics = is_grouped ? "(" + grouped_tics(axis.low, axis.high, axis.step) + ")"
                                      : fmt::format("{:.12g}", axis.step);
  return fmt::format("set yrange [{:.12g}:{:.12g}]\nset ytics {}\nset format y '{}'\n", axis.low,
                     axis.high, tics, is_long ? "%.1s%c" : format_of(axis));
}

std::string y_axis(double low, double high, int most_steps) {
  return axis_settings(axis_around(low, high, most_steps));
}

std::string common_scenario(std::span<const RunGroup> groups) {
  const std::string first = scenario_title(groups.front().runs.front()->scenario);
  const bool is_common = std::all_of(groups.begin(), groups.end(), [&](const RunGroup& group) {
    return scenario_title(group.runs.front()->scenario) == first;
  });
  return is_common ? first : "";
}

std::string label_below(std::string_view title, const std::string& label) {
  const std::string said = std::string(title) + ", ";
  return !title.empty() && label.starts_with(said) ? label.substr(said.size()) : label;
}

std::string seeds_label(std::string_view label, std::size_t seeds) {
  return fmt::format("{} ({}){}", label, counted(seeds, "seed"),
                     seeds >= kLeastSeedsOfBand ? ", 95 % interval" : "");
}

KeyEntry key_of_seeds() {
  return {.colour = kPlotGrey, .text = "thin: each of two seeds; thick: their mean", .line = 0.5};
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

std::string run_and_seed(const RunRecord& record) {
  return fmt::format("{}, seed {}", run_title(record), record.scenario.seed);
}

double count_up_to(const ViewRecord& view) { return view.iteration + 1.0; }

std::array<double, 2> views_range(std::span<const ViewRecord> views) {
  return {count_up_to(views.front()) - 0.5, count_up_to(views.back()) + 0.5};
}

Panels::Panels(std::size_t count, std::string_view title, std::string_view x_label,
               const std::array<double, 2>& x_range, std::vector<KeyEntry> key)
    : count_(count), title_(title), x_label_(x_label), x_range_(x_range), key_(std::move(key)) {}

int Panels::height_px() const {
  const int panels_px = count_ < 3 ? 1150 : count_ < 5 ? 1450 : count_ < 6 ? 1750 : 2000;
  return panels_px + kKeyRow_px * static_cast<int>(key_rows(key_).size());
}

/// What all panels have in common.
std::string Panels::frame() const {
  std::string text = fmt::format(
      "set multiplot\nunset key\nunset xlabel\nset lmargin at screen {}\nset rmargin at screen "
      "{}\nset xrange [{}:{}]\n",
      kLeft, kRight, x_range_[0], x_range_[1]);
  text += title_label(title_, height_px());
  return text + left_key(key_, height_px());
}

std::string Panels::next(std::string_view heading, const std::vector<KeyEntry>& key) {
  const auto n = static_cast<double>(count_);
  const auto all_px = static_cast<double>(height_px());
  const double bottom_px = 2.9 * kTextLine_px;
  const double heading_px = 1.9 * kTextLine_px;
  const double above_px =
      1.5 * kTextLine_px + kKeyRow_px * static_cast<double>(key_rows(key_).size());
  const double each_px = (all_px - above_px - bottom_px) / n;
  const double top_px = above_px + heading_px + static_cast<double>(drawn_) * each_px;
  const auto screen = [&](double px) { return 1.0 - px / all_px; };
  const bool is_last = drawn_ + 1 == count_;
  std::string text = drawn_ == 0 ? frame() : "unset label\nunset arrow\n";
  text += fmt::format("set tmargin at screen {:.4f}\nset bmargin at screen {:.4f}\n",
                      screen(top_px), screen(top_px + each_px - heading_px));
  const double heading_y = screen(top_px - 0.75 * kTextLine_px);
  text += fmt::format("set label 2 {} at screen {},{:.4f} left textcolor rgb '#5c6470'\n",
                      gnuplot_text(heading), kLeft, heading_y);
  text += key_row(key, heading_y);
  const double step = even_step(std::max(x_range_[1] - x_range_[0], 1.0));
  text += is_last ? "set format x '%g'\n" + x_tics(x_range_[0], x_range_[1], step)
                  : fmt::format("set format x ''\nset xtics {:g}\n", step);
  if (is_last) {
    text +=
        fmt::format("set label 3 {} at graph 0.5,screen {:.4f} center textcolor rgb '#262c36'\n",
                    gnuplot_text(x_label_), 0.6 * kTextLine_px / all_px);
  }
  drawn_ += 1;
  return text;
}

}  // namespace gnbv
