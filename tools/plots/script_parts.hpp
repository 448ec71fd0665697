// What the scripts of all plots share.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/plots/curves.hpp"
#include "tools/plots/key.hpp"
#include "tools/run/method_slots.hpp"

namespace gnbv {

/// Okabe and Ito's colours, which people with colour blindness tell apart (2008); darkest first.
constexpr std::array<std::string_view, 7> kPalette = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                      "#e69f00", "#56b4e9", "#000000"};

/// The colour of a number of method_slots(); beyond the palette its colours begin again.
constexpr std::string_view palette_colour(std::size_t slot) {
  return kPalette[slot % kPalette.size()];
}

/// The dashes of a number of method_slots(): curves that lie on each other show both. Together with
/// the colour they are a method's own for 35 methods.
std::string_view method_dashes(std::size_t slot);

/// Of the axis that this effort is on: "path since the first view, straight legs (m)".
std::string_view effort_label(Effort effort);
/// Of an axis that holds only the end of it: "last 15 % of the path, straight legs (m)".
std::string end_label(Effort effort, int percent);
/// In the names of plots: "metres".
std::string_view effort_name(Effort effort);

/// A block of data by name: a row of numbers a line, as they are.
std::string data_block(std::string_view name, const std::vector<std::vector<double>>& rows);

/// Rectangles behind the plot that mark the phases, from half a view before to half after: on an
/// axis of views, the one of iteration 0 is the first.
std::string shaded_phases(const std::vector<Phase>& phases);

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

/// An axis on as few even steps, two at least and `most_steps` at most, as lie closest around both:
/// it begins and ends on a mark.
Axis close_axis(double low, double high, int most_steps = 3);

/// The tics of an axis at whole multiples of `step`, thousands separated, which gnuplot does in
/// some locales only. Requires low <= high, step > 0.
std::string x_tics(double low, double high, double step);

/// Settings of a y axis: its range, and marks at whole steps with as many decimals as the step has.
std::string axis_settings(const Axis& axis);
/// Settings of a y axis that is axis_around() them.
std::string y_axis(double low, double high, int most_steps = 5);
/// The scenario of all of them, for people; nothing where they have several. Requires a group.
std::string common_scenario(std::span<const RunGroup> groups);
/// What a key says of a group below that title: "Proposed".
std::string label_below(std::string_view title, const std::string& label);

/// An interval of the mean of fewer seeds says nothing: their own curves do.
constexpr std::size_t kLeastSeedsOfBand = 3;
/// "Proposed (2 seeds)"; where a band is drawn, "Proposed (5 seeds), 95 % interval".
std::string seeds_label(std::string_view label, std::size_t seeds);
/// What the thin lines of two seeds are.
KeyEntry key_of_seeds();

/// A mark of its own for the end of a curve, so that it shows under another's.
int end_mark(std::size_t slot);
/// The entries of a plot command, each with its comma, that set it, edged in white, where the
/// block's row is.
std::string end_points(std::string_view block, std::size_t slot);

/// Who flew, and by which seed: the title of a plot of one run.
std::string run_and_seed(const RunRecord& record);

/// How many views were taken with this one: on an axis, the first view is 1.
double count_up_to(const ViewRecord& view);
/// Half a view around them. Requires views.
std::array<double, 2> views_range(std::span<const ViewRecord> views);

/// Panels one above the other with the same width and one x axis over a range that is not empty,
/// labelled below the last one. Each has a heading, and beside that a key of one row; a key of all
/// of them stands below the title.
class Panels {
 public:
  Panels(std::size_t count, std::string_view title, std::string_view x_label,
         const std::array<double, 2>& x_range, std::vector<KeyEntry> key = {});
  /// The settings of the next panel, to stand before its plot command.
  std::string next(std::string_view heading, const std::vector<KeyEntry>& key = {});
  /// Of the whole picture, 1512 pixels wide.
  int height_px() const;

 private:
  std::string frame() const;

  std::size_t count_;
  std::size_t drawn_ = 0;
  std::string title_;
  std::string x_label_;
  std::array<double, 2> x_range_;
  std::vector<KeyEntry> key_;
};

}  // namespace gnbv
