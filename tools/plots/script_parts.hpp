// What the scripts of all plots share.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/plots/curves.hpp"
#include "tools/run_files/method_slots.hpp"

namespace gnbv {

/// Okabe and Ito's colours, which people with colour blindness tell apart (2008); darkest first.
constexpr std::array<std::string_view, 7> kPalette = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                      "#e69f00", "#56b4e9", "#000000"};

/// The colour of a number of method_slots(); beyond the palette its colours begin again.
constexpr std::string_view palette_colour(std::size_t slot) {
  return kPalette[slot % kPalette.size()];
}

/// Of the axis that this effort is on: "straight path from the first view on (m)".
std::string_view effort_label(Effort effort);
/// In the names of plots: "metres".
std::string_view effort_name(Effort effort);

/// A block of data by name: a row of numbers a line, as they are.
std::string data_block(std::string_view name, const std::vector<std::vector<double>>& rows);

/// Rectangles behind the plot that mark the phases, from half a view before to half after: on an
/// axis of views, the one of iteration 0 is the first.
std::string shaded_phases(const std::vector<Phase>& phases);

constexpr std::string_view kSquareMark = "\u25a0";
constexpr std::string_view kDashedMark = "-\u2009-";

/// A mark of a colour and what it stands for.
struct KeyEntry {
  std::string_view colour;
  std::string_view text;
  std::string_view mark = kSquareMark;
};

/// A key in one row that ends at the right edge of the panels.
std::string key_row(const std::vector<KeyEntry>& key, double screen_y);

/// What explains the shades; nothing without phases.
std::vector<KeyEntry> key_of_phases(const std::vector<Phase>& phases);

/// 1, 2 or 5 times a power of ten, of which `span` holds at most so many. Requires span > 0.
double even_step(double span, int most = 5);

struct Axis {
  double low = 0.0;
  double high = 0.0;
  double step = 0.0;
};

/// From `low` to `high`, widened to whole even steps, of which that span holds at most so many.
/// Requires low <= high.
Axis axis_around(double low, double high, int most_steps = 5);

/// The tics of an x axis at whole multiples of `step`, thousands separated, which gnuplot does in
/// some locales only. Requires low <= high, step > 0.
std::string x_tics(double low, double high, double step);

/// Settings of a y axis that is axis_around() them.
std::string y_axis(double low, double high, int most_steps = 5);
/// The same, but no longer than a little beyond both: with more marks where fewer than two of them
/// would lie in between.
std::string tight_y_axis(double low, double high, int most_steps = 5);

constexpr int kOnePanel_px = 1050;  // the height of a picture of one panel, 1512 wide
constexpr int kKeyLine_px = 60;

/// Settings of a key of so many lines above a plot of one panel, whose picture is
/// height_with_key_px() high: inside, gnuplot leaves out one that is too wide.
std::string key_above(std::size_t entries);
int height_with_key_px(std::size_t entries);

/// The scenario of all of them, for people; nothing where their labels say it. Requires a group,
/// and figures.
std::string common_scenario(std::span<const RunGroup> groups);
/// Above a plot of one panel, beside its key; nothing where it is empty.
std::string title_at_right(std::string_view title, int height_px);

/// A mark of its own for the end of a curve, so that it shows under another's.
int end_mark(std::size_t slot);
/// The entries of a plot command, each with its comma, that set it, edged in white, where the
/// block's row is.
std::string end_points(std::string_view block, std::size_t slot);

/// The height of a picture of so many panels that is 1512 pixels wide.
int panels_height_px(std::size_t count);

/// Panels one above the other with the same width and one x axis over a range that is not empty,
/// labelled below the last one. Each
/// has a heading, and beside that a key of one row: gnuplot's own would be laid out by the widths
/// that each terminal takes letters for, and differ from format to format.
class Panels {
 public:
  Panels(std::size_t count, std::string_view title, std::string_view x_label,
         const std::array<double, 2>& x_range);
  /// The settings of the next panel, to stand before its plot command.
  std::string next(std::string_view heading, const std::vector<KeyEntry>& key = {});

 private:
  std::size_t count_;
  std::size_t drawn_ = 0;
  std::string title_;
  std::string x_label_;
  std::array<double, 2> x_range_;
};

}  // namespace gnbv
