// A figure as data: what is drawn, in which order and with which words. tools/python/gnbv/plots
// draws it; figures.schema.json says how it is written.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/figures/looks.hpp"

namespace gnbv {

// ---- axes.cpp: ranges, even steps, and what their ticks say

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

// ---- figure.cpp

/// How a series is drawn. `steps` keeps each y until the next x; `area` fills from low to high;
/// `interval` is a point with a bar from low to high along x; `level` is its first y all the way.
enum class Mark { line, steps, points, area, interval, level };

/// One row of numbers. A y that is not known (NaN) breaks the line.
struct Series {
  std::string name;        // in the CSV file
  std::string label = {};  // in the legend; empty: not there
  Mark mark = Mark::line;
  SeriesLook look = {};
  double width_pt = 0.75;  // of a line; 0: none; in a figure of 3.5 inches
  double size_pt = 2.4;    // of a point
  double opacity = 1.0;
  bool is_filled = true;  // a point; else white inside
  std::vector<double> x = {};
  std::vector<double> y = {};
  std::vector<double> low = {};  // of a band around y, or of an interval along x; empty: none
  std::vector<double> high = {};
  std::optional<std::array<double, 2>> end = {};  // a mark there: x, y
};

/// Parts of the x axis that are shaded behind the series.
struct Shades {
  std::string label = {};  // in the legend; empty: not there
  std::vector<std::array<double, 2>> spans = {};
};

struct FigurePanel {
  std::string heading = {};
  Axis x = {};
  Axis y = {};
  Shades shades = {};
  std::vector<Series> series = {};
  int height_px = 300;          // of its frame, in a figure of 1512
  bool has_categories = false;  // the ticks of y name bands, which alternate in colour
};

struct Figure {
  std::string name;  // of its file, without extension
  std::string kind;  // "coverage"
  std::string title = {};
  std::vector<std::string> notes = {};  // below the legend, a sentence each
  std::vector<FigurePanel> panels = {};
  /// How many panels stand beside each other, row by row. Empty: one in each.
  std::vector<int> panels_in_rows = {};
};

/// All of them as one document of figures.schema.json.
std::string figures_json(std::span<const Figure> figures);

/// The JSON Schema of that document.
std::string_view figures_schema();

/// A row a point: panel, series, x, y, low, high. What is not known is empty.
std::string figure_csv(const Figure& figure);

}  // namespace gnbv
