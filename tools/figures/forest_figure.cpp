// forest_figure() of group_figures.hpp: paired differences of methods with their intervals.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/core/text.hpp"
#include "tools/figures/group_figures.hpp"

namespace gnbv {
namespace {

constexpr int kMethod_px = 34;
constexpr int kBetweenMetrics_px = 28;

/// Both ends of the axis, with 0 between: half beyond the largest mean on either side unless all
/// intervals end before, so that few seeds do not press everything else together.
Axis difference_axis(std::string_view label, std::span<const Series> rows) {
  double low = 0.0, high = 0.0, largest = 0.0;
  for (const Series& series : rows) {
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      low = std::min(low, series.low[i]);
      high = std::max(high, series.high[i]);
      largest = std::max(largest, std::abs(series.x[i]));
    }
  }
  if (low == high) return axis_from(label, -1.0, 1.0);  // no difference anywhere
  low = std::max(low, -1.5 * largest);
  high = std::min(high, 1.5 * largest);
  const double room = 0.04 * (high - low);  // for an arrow
  return axis_from(label, low - room, high + room, 6);
}

/// A row of a panel: an interval in the unit of the axis.
struct ForestRow {
  std::size_t band = 0;  // of its metric, from above
  const MethodFigure* figure = nullptr;
  double scale = 1.0;
};

/// The rows of one method, those that are significant or the others; each band of a metric is one
/// high, from 0 downwards, and has a place for each method but the baseline.
Series series_of(const Comparison& comparison, std::span<const ForestRow> rows, std::size_t method,
                 bool is_significant) {
  const std::string name = human_name(comparison.methods[method]);
  Series series{.name = name + (is_significant ? ", significant" : ""),
                .mark = Mark::interval,
                .is_filled = is_significant};
  const std::size_t place = method - (method > comparison.baseline ? 1 : 0);
  const auto places = static_cast<double>(comparison.methods.size() - 1);
  for (const auto& [band, figure, scale] : rows) {
    const bool is_its = (figure->contrast->verdict == Verdict::significant) == is_significant;
    if (figure->method != method || !is_its) continue;
    const MeanEstimate& difference = figure->contrast->difference;
    series.x.push_back(scale * difference.mean);
    series.y.push_back(-static_cast<double>(band) -
                       (0.1 + 0.8 * (static_cast<double>(place) + 0.5) / places));
    series.low.push_back(scale * (difference.mean - *difference.half_width));
    series.high.push_back(scale * (difference.mean + *difference.half_width));
  }
  return series;
}

/// Metrics whose differences have one unit. The methods are named in the first panel's legend.
/// Nothing where no difference has an interval.
std::optional<FigurePanel> panel_of(const Comparison& comparison, std::size_t scenario,
                                    bool of_shares, bool is_first) {
  std::vector<std::string> metrics;
  std::vector<ForestRow> rows;
  for (const MethodFigure& figure : comparison.figures) {
    const std::string& metric = comparison.metrics[figure.metric].name;
    if (figure.scenario != scenario || !figure.contrast) continue;
    if (metric.ends_with("(%)") != of_shares || !figure.contrast->difference.half_width) continue;
    const double base = std::abs(figure.contrast->baseline_mean);
    if (!of_shares && base == 0.0) continue;
    const std::string name = metric.substr(0, metric.rfind(" ("));  // the unit is the axis's
    if (metrics.empty() || metrics.back() != name) metrics.push_back(name);
    rows.push_back({metrics.size() - 1, &figure, of_shares ? 1.0 : 100.0 / base});
  }
  if (rows.empty()) return std::nullopt;
  const auto bands = static_cast<int>(metrics.size());
  const auto methods = static_cast<int>(comparison.methods.size());
  FigurePanel panel{.height_px = bands * (kBetweenMetrics_px + kMethod_px * (methods - 1)),
                    .has_categories = true};
  const std::vector<SeriesLook> looks = method_looks(comparison.methods);
  for (std::size_t method = 0; method < comparison.methods.size(); ++method) {
    for (const bool is_significant : {true, false}) {
      Series series = series_of(comparison, rows, method, is_significant);
      series.look = looks[method];
      if (!series.x.empty()) panel.series.push_back(std::move(series));
    }
    if (!is_first || method == comparison.baseline) continue;
    const std::string name = human_name(comparison.methods[method]);
    panel.series.push_back({.name = name,
                            .label = name,
                            .mark = Mark::points,
                            .look = looks[method],
                            .width_pt = 0.0});
  }
  panel.x = difference_axis(
      fmt::format("difference to {} ({})", human_name(comparison.methods[comparison.baseline]),
                  of_shares ? "percentage points" : "% of its mean"),
      panel.series);
  panel.y = {.low = -static_cast<double>(bands), .high = 0.0};
  for (const std::string& metric : metrics) {
    panel.y.ticks.push_back({-0.5 - static_cast<double>(panel.y.ticks.size()), metric});
  }
  panel.series.push_back({.name = "no difference",
                          .look = {.colour = std::string(kPlotGrey)},
                          .x = {0.0, 0.0},
                          .y = {panel.y.low, panel.y.high}});
  return panel;
}

}  // namespace

std::optional<Figure> forest_figure(const Comparison& comparison, std::size_t scenario) {
  Figure figure{.name = "forest-" + comparison.scenarios[scenario],
                .kind = "forest",
                .title = human_name(comparison.scenarios[scenario]),
                .notes = {"95 % intervals; filled: significant after Holm; an arrow: goes on"}};
  for (const bool of_shares : {true, false}) {
    auto panel = panel_of(comparison, scenario, of_shares, figure.panels.empty());
    if (panel) figure.panels.push_back(std::move(*panel));
  }
  if (figure.panels.empty()) return std::nullopt;
  return figure;
}

}  // namespace gnbv
