#include "tools/figures/forest_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/core/text.hpp"

namespace gnbv {
namespace {

constexpr int kMethod_px = 34;
constexpr int kBetweenMetrics_px = 28;

bool is_share(const std::string& metric) { return metric.ends_with("(%)"); }

/// Differences have the unit of the axis.
std::string without_unit(const std::string& metric) { return metric.substr(0, metric.rfind(" (")); }

/// The rows of one method in a panel: those that are significant, and the others.
struct MethodRows {
  Series significant{.name = "", .mark = Mark::interval};
  Series open{.name = "", .mark = Mark::interval, .is_filled = false};
};

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

/// Metrics whose differences have one unit, on alternating bands from 0 downwards.
class ForestPanel {
 public:
  ForestPanel(const Comparison& comparison, std::size_t scenario, bool of_shares)
      : comparison_(comparison), rows_(comparison.methods.size()), of_shares_(of_shares) {
    for (const MethodFigure& figure : comparison.figures) {
      const std::string& metric = comparison.metrics[figure.metric].name;
      if (figure.scenario == scenario && figure.contrast && is_share(metric) == of_shares) {
        add(figure, metric);
      }
    }
  }

  bool is_empty() const { return metrics_.empty(); }

  /// Requires that it is not empty. The methods are named in the first panel's legend.
  FigurePanel panel(bool is_first) {
    const std::vector<SeriesLook> looks = method_looks(comparison_.methods);
    FigurePanel panel{
        .height_px =
            static_cast<int>(metrics_.size()) *
            (kBetweenMetrics_px + kMethod_px * (static_cast<int>(comparison_.methods.size()) - 1)),
        .has_categories = true};
    for (std::size_t method = 0; method < rows_.size(); ++method) {
      const std::string name = human_name(comparison_.methods[method]);
      for (Series* const series : {&rows_[method].significant, &rows_[method].open}) {
        if (series->x.empty()) continue;
        series->name = name + (series->is_filled ? ", significant" : "");
        series->look = looks[method];
        panel.series.push_back(std::move(*series));
      }
      if (!is_first || method == comparison_.baseline) continue;
      panel.series.push_back({.name = name,
                              .label = name,
                              .mark = Mark::points,
                              .look = looks[method],
                              .width_pt = 0.0});
    }
    panel.x = difference_axis(
        fmt::format("difference to {} ({})", human_name(comparison_.methods[comparison_.baseline]),
                    of_shares_ ? "percentage points" : "% of its mean"),
        panel.series);
    panel.y.low = -static_cast<double>(metrics_.size());
    panel.y.high = 0.0;
    for (std::size_t i = 0; i < metrics_.size(); ++i) {
      panel.y.ticks.push_back({-0.5 - static_cast<double>(i), without_unit(metrics_[i])});
    }
    panel.series.push_back({.name = "no difference",
                            .look = {.colour = std::string(kPlotGrey)},
                            .x = {0.0, 0.0},
                            .y = {panel.y.low, panel.y.high}});
    return panel;
  }

 private:
  void add(const MethodFigure& figure, const std::string& metric) {
    const MeanEstimate& difference = figure.contrast->difference;
    const double base = std::abs(figure.contrast->baseline_mean);
    if (!difference.half_width || !(of_shares_ || base > 0.0)) return;
    if (metrics_.empty() || metrics_.back() != metric) metrics_.push_back(metric);
    const double scale = of_shares_ ? 1.0 : 100.0 / base;
    const std::size_t place = figure.method - (figure.method > comparison_.baseline ? 1 : 0);
    const auto places = static_cast<double>(comparison_.methods.size() - 1);
    MethodRows& rows = rows_[figure.method];
    Series& series =
        figure.contrast->verdict == Verdict::significant ? rows.significant : rows.open;
    series.x.push_back(scale * difference.mean);
    series.y.push_back(1.0 - static_cast<double>(metrics_.size()) -
                       (0.1 + 0.8 * (static_cast<double>(place) + 0.5) / places));
    series.low.push_back(scale * (difference.mean - *difference.half_width));
    series.high.push_back(scale * (difference.mean + *difference.half_width));
  }

  const Comparison& comparison_;
  std::vector<std::string> metrics_ = {};
  std::vector<MethodRows> rows_;  // of each method
  bool of_shares_;
};

}  // namespace

std::optional<Figure> forest_figure(const Comparison& comparison, std::size_t scenario) {
  Figure figure{.name = "forest-" + comparison.scenarios[scenario],
                .kind = "forest",
                .title = human_name(comparison.scenarios[scenario]),
                .notes = {"95 % intervals; filled: significant after Holm; an arrow: goes on"}};
  for (const bool of_shares : {true, false}) {
    ForestPanel panel(comparison, scenario, of_shares);
    if (!panel.is_empty()) figure.panels.push_back(panel.panel(figure.panels.empty()));
  }
  if (figure.panels.empty()) return std::nullopt;
  return figure;
}

}  // namespace gnbv
