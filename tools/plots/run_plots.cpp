#include "tools/plots/run_plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tools/plots/gnuplot.hpp"
#include "tools/plots/script_parts.hpp"

namespace gnbv {
namespace {

using Columns = std::vector<std::vector<double>>;

// palette colours on white, as large areas want them
constexpr std::string_view kDensityArea = "#66abd1";
constexpr std::string_view kPredictionArea = "#e69e66";
constexpr std::size_t kManyViews = 100;
constexpr std::size_t kWindow = 15;  // views that a mean is taken over, when there are many

std::string title_of(const RunRecord& record) {
  return fmt::format("{}, seed {}", run_title(record), record.scenario.seed);
}

/// How many views were taken with this one: on an axis, the first view is 1.
double count_up_to(const ViewRecord& view) { return view.iteration + 1.0; }

std::array<double, 2> x_range(const std::vector<ViewRecord>& views) {
  return {count_up_to(views.front()) - 0.5, count_up_to(views.back()) + 0.5};
}

/// The views that somebody scored, with a value of 0, too: not the start, nor those of a route.
std::vector<ViewRecord> scored_views(const RunRecord& record) {
  std::vector<ViewRecord> scored;
  std::copy_if(record.views.begin(), record.views.end(), std::back_inserter(scored),
               [](const ViewRecord& view) {
                 const Score& s = view.decision.score;
                 return s.value != 0.0 || s.information != 0.0 || s.distance != 1.0;
               });
  return scored;
}

/// Columns, each smoothed, beside the views' numbers.
std::vector<std::vector<double>> rows_of(const std::vector<ViewRecord>& views,
                                         const Columns& columns, std::size_t window) {
  std::vector<std::vector<double>> rows(views.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    rows[i].push_back(count_up_to(views[i]));
  }
  for (const auto& column : columns) {
    const std::vector<double> smooth = moving_mean(column, window);
    for (std::size_t i = 0; i < views.size(); ++i) rows[i].push_back(smooth[i]);
  }
  return rows;
}

template <typename Value>
std::vector<double> column_of(const std::vector<ViewRecord>& views, const Value& value) {
  std::vector<double> column;
  for (const ViewRecord& view : views) column.push_back(value(view.decision.score));
  return column;
}

/// What the terms of Eq. (2) come to, by their weights.
struct Eq2 {
  explicit Eq2(const UtilityConfig& config) : alpha(config.alpha) {
    const double weights = config.normalise_weights ? config.beta + config.gamma : 1.0;
    beta = config.beta / weights;
    gamma = config.gamma / weights;
  }
  double density(const Score& s) const { return beta * s.density; }
  double prediction(const Score& s) const { return gamma * s.prediction; }
  double information(const Score& s) const { return 1.0 + alpha * s.information; }
  /// What remains of the value: log10 of the occupied voxels in view, which no file holds; not
  /// known where another term is 0.
  double size(const Score& s) const {
    const double others = information(s) * (density(s) + prediction(s)) * s.distance;
    return others > 0.0 ? s.value / others : std::numeric_limits<double>::quiet_NaN();
  }

  double alpha = 0.0;
  double beta = 0.0;
  double gamma = 0.0;
};

/// Value, density, prediction, information, distance, size.
Columns columns_of_eq2(const std::vector<ViewRecord>& views, const Eq2& eq2) {
  return {column_of(views, [](const Score& s) { return s.value; }),
          column_of(views, [&](const Score& s) { return eq2.density(s); }),
          column_of(views, [&](const Score& s) { return eq2.prediction(s); }),
          column_of(views, [&](const Score& s) { return eq2.information(s); }),
          column_of(views, [](const Score& s) { return s.distance; }),
          column_of(views, [&](const Score& s) { return eq2.size(s); })};
}

/// Value, gain, distance.
Columns columns_of(const std::vector<ViewRecord>& views) {
  return {column_of(views, [](const Score& s) { return s.value; }),
          column_of(views, [](const Score& s) { return s.information; }),
          column_of(views, [](const Score& s) { return s.distance; })};
}

std::string line(std::string_view data, int column, std::size_t colour) {
  return fmt::format("${} using 1:{} with lines lw 1.2 lc rgb '{}'", data, column,
                     kPalette[colour]);
}

/// The single values behind their means, where means are drawn.
std::string raw_line(int column, std::size_t colour, bool is_smooth) {
  if (!is_smooth) return "";
  return fmt::format("$raw using 1:{} with lines lw 0.35 lc rgb '#b0{}', ", column,
                     kPalette[colour].substr(1));
}

/// An axis from 0 that holds all of a column.
std::string axis_of(const std::vector<double>& column) {
  return y_axis(0.0, *std::max_element(column.begin(), column.end()));
}

std::string heading_of_utility(bool is_smooth, bool is_proposed) {
  const std::string formula = is_proposed ? "utility = L Q I D" : "utility";
  return is_smooth ? fmt::format("{} (means of {})", formula, kWindow) : formula;
}

std::string utility_panel(Panels& panels, const Columns& columns, const std::vector<Phase>& phases,
                          bool is_smooth) {
  constexpr std::size_t kColumnsOfEq2 = 6;
  return panels.next(heading_of_utility(is_smooth, columns.size() == kColumnsOfEq2),
                     key_of_phases(phases)) +
         axis_of(columns[0]) + "plot " + raw_line(2, 6, is_smooth) + line("mean", 2, 6) + "\n";
}

std::string heading_of_quality(bool has_prediction, double most_prediction) {
  if (has_prediction) return "Q, the sum of";
  if (most_prediction == 0.0) return "Q, nothing predicted";
  return fmt::format("Q, γ prediction up to {:.2g}", most_prediction);
}

std::string factor_panels(Panels& panels, const Columns& columns, bool is_smooth) {
  std::vector<double> quality = columns[1];
  std::vector<double> factors = columns[3];
  for (std::size_t i = 0; i < quality.size(); ++i) {
    quality[i] += columns[2][i];
    factors[i] = std::max({factors[i], columns[4][i], columns[5][i]});
  }
  // a share of the panel that nobody sees is a number in the heading
  constexpr double kLeastSeen = 0.02;
  const double most = *std::max_element(columns[2].begin(), columns[2].end());
  const bool has_prediction = most > kLeastSeen * *std::max_element(quality.begin(), quality.end());
  std::vector<KeyEntry> terms = {{kDensityArea, "β density"}};
  if (has_prediction) terms.push_back({kPredictionArea, "γ prediction"});
  std::string text =
      panels.next(heading_of_quality(has_prediction, most), terms) + axis_of(quality);
  // the sum behind the density: no prediction leaves no hair of its colour
  text += fmt::format(
      "plot $mean using 1:(0):($3+$4) with filledcurves fc rgb '{}' fs solid noborder, "
      "$mean using 1:(0):3 with filledcurves fc rgb '{}' fs solid noborder\n",
      kPredictionArea, kDensityArea);
  text += panels.next("", {{kPalette[2], "I = 1 + α E"},
                           {kPalette[3], "D = exp(−λ d)"},
                           {kPalette[4], "L = log10 N"}}) +
          axis_of(factors) + "plot " + raw_line(5, 2, is_smooth) + raw_line(6, 3, is_smooth) +
          raw_line(7, 4, is_smooth);
  return text + line("mean", 5, 2) + ", " + line("mean", 6, 3) + ", " + line("mean", 7, 4) + "\n";
}

/// Whether the last column, the distance factor, ever says anything.
bool is_discounted(const Columns& columns) {
  return std::any_of(columns.back().begin(), columns.back().end(),
                     [](double factor) { return factor != 1.0; });
}

std::string discount_panels(Panels& panels, const Columns& columns, bool is_smooth) {
  std::string text = panels.next("the product of gain");  // one after the other: next() counts
  text += axis_of(columns[1]) + "plot " + raw_line(3, 0, is_smooth) + line("mean", 3, 0) + "\n";
  text += panels.next("and distance factor");
  text += y_axis(0.0, 1.0) + "plot " + raw_line(4, 3, is_smooth) + line("mean", 4, 3) + "\n";
  return text;
}

}  // namespace

std::optional<Plot> density_entropy_plot(const RunRecord& record, bool has_density) {
  if (record.views.empty()) return std::nullopt;
  Columns columns(2);
  std::vector<std::vector<double>> rows;
  for (const ViewRecord& view : record.views) {
    columns[0].push_back(view.entropy_nat);
    columns[1].push_back(view.density_points_per_voxel);
    rows.push_back({count_up_to(view), view.entropy_nat, view.density_points_per_voxel});
  }
  const auto [low, high] = std::minmax_element(columns[0].begin(), columns[0].end());
  const double unit_nat = *high >= 10'000.0 ? 1000.0 : 1.0;
  const std::vector<Phase> phases = frontier_phases(record.views);
  const std::size_t count = has_density ? 2 : 1;
  Panels panels(count, title_of(record), "views", x_range(record.views));
  std::string text = data_block("views", rows) + shaded_phases(phases);
  text +=
      panels.next(unit_nat > 1.0 ? "entropy (1,000 nat)" : "entropy (nat)", key_of_phases(phases));
  text += y_axis(*low / unit_nat, *high / unit_nat);
  text += fmt::format("plot $views using 1:($2/{}) with lines lw 1.3 lc rgb '{}'\n", unit_nat,
                      kPalette[0]);
  if (has_density) {
    text += panels.next("density (points/voxel)") + axis_of(columns[1]);
    text += fmt::format("plot $views using 1:3 with lines lw 1.3 lc rgb '{}'\n", kPalette[1]);
  }
  return Plot{has_density ? "density" : "entropy", text + "unset multiplot\n",
              panels_height_px(count)};
}

std::optional<Plot> terms_plot(const RunRecord& record) {
  const std::vector<ViewRecord> views = scored_views(record);
  if (views.empty()) return std::nullopt;
  const UtilityConfig& utility = record.scenario.planner.utility;
  const bool is_proposed = utility.name == "proposed";
  const Columns columns = is_proposed ? columns_of_eq2(views, Eq2(utility)) : columns_of(views);
  const bool is_smooth = views.size() > kManyViews;
  const std::size_t count = is_proposed || is_discounted(columns) ? 3 : 1;
  const std::vector<Phase> phases = frontier_phases(record.views);
  Panels panels(count, title_of(record), "views", x_range(record.views));
  std::string text = data_block("raw", rows_of(views, columns, 1)) +
                     data_block("mean", rows_of(views, columns, is_smooth ? kWindow : 1)) +
                     shaded_phases(phases) + utility_panel(panels, columns, phases, is_smooth);
  if (is_proposed) {
    text += factor_panels(panels, columns, is_smooth);
  } else if (count > 1) {
    text += discount_panels(panels, columns, is_smooth);
  }
  return Plot{"terms", text + "unset multiplot\n", panels_height_px(count)};
}

}  // namespace gnbv
