#include "tools/plots/terms_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tools/plots/script_parts.hpp"

namespace gnbv {
namespace {

using Columns = std::vector<std::vector<double>>;

// palette colours on white, as large areas want them
constexpr std::string_view kDensityArea = "#66abd1";
constexpr std::string_view kPredictionArea = "#e69e66";
constexpr std::size_t kManyViews = 100;
constexpr std::size_t kWindow = 15;  // views that a mean is taken over, when there are many

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
  explicit Eq2(const UtilityConfig& config)
      : is_normalised(config.normalise_weights), alpha(config.alpha) {
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

  bool is_normalised = true;
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

/// An axis from 0 that holds all of a column that is known.
std::string axis_of(const std::vector<double>& column) {
  double most = 0.0;
  for (const double value : column) most = std::isnan(value) ? most : std::max(most, value);
  return axis_settings(close_axis(0.0, most));
}

std::string utility_panel(Panels& panels, const Columns& columns, bool is_smooth) {
  constexpr std::size_t kColumnsOfEq2 = 6;
  return panels.next(columns.size() == kColumnsOfEq2 ? "utility = L Q I exp(−λ d)" : "utility") +
         axis_of(columns[0]) + "plot " + raw_line(2, 6, is_smooth) + line("mean", 2, 6) + "\n";
}

/// Q, and what there is of a prediction that nobody sees beside the density.
std::string heading_of_quality(const Eq2& eq2, double most_prediction, bool is_seen) {
  const std::string formula = eq2.is_normalised ? "Q = (β D + γ P) / (β + γ)" : "Q = β D + γ P";
  if (is_seen) return formula;
  if (most_prediction == 0.0) return formula + ", P = 0";
  return fmt::format("{}, P ≤ {:.2g}", formula, most_prediction / eq2.gamma);
}

std::string quality_panel(Panels& panels, const Columns& columns, const Eq2& eq2) {
  std::vector<double> quality = columns[1];
  for (std::size_t i = 0; i < quality.size(); ++i) quality[i] += columns[2][i];
  // a share of the panel that nobody sees is a number in the heading
  constexpr double kLeastSeen = 0.02;
  const double most = *std::max_element(columns[2].begin(), columns[2].end());
  const bool is_seen = most > kLeastSeen * *std::max_element(quality.begin(), quality.end());
  std::vector<KeyEntry> terms = {{.colour = kDensityArea, .text = "D, density"}};
  if (is_seen) terms.push_back({.colour = kPredictionArea, .text = "P, prediction"});
  // the sum behind the density: no prediction leaves no hair of its colour
  return panels.next(heading_of_quality(eq2, most, is_seen), terms) + axis_of(quality) +
         fmt::format(
             "plot $mean using 1:(0):($3+$4) with filledcurves fc rgb '{}' fs solid noborder, "
             "$mean using 1:(0):3 with filledcurves fc rgb '{}' fs solid noborder\n",
             kPredictionArea, kDensityArea);
}

/// A factor alone; where single views are drawn, each has a point: one may have no neighbours.
std::string factor_panel(Panels& panels, const Columns& columns, std::size_t factor,
                         std::string_view heading, bool is_smooth) {
  const int column = static_cast<int>(factor) + 2;  // gnuplot counts from 1, and views come first
  const std::size_t colour = factor - 1;
  std::string text = panels.next(heading) + axis_of(columns[factor]) + "plot " +
                     raw_line(column, colour, is_smooth) + line("mean", column, colour);
  if (!is_smooth) {
    text += fmt::format(", $raw using 1:{} with points pt 7 ps 0.2 lc rgb '{}'", column,
                        kPalette[colour]);
  }
  return text + "\n";
}

std::string factor_panels(Panels& panels, const Columns& columns, bool is_smooth) {
  const bool is_defined = std::none_of(columns[5].begin(), columns[5].end(),
                                       [](double value) { return std::isnan(value); });
  const std::string size =
      fmt::format("L = log₁₀ N, N occupied voxels{}", is_defined ? " in view" : " (where defined)");
  // one after the other: next() counts
  std::string text = factor_panel(panels, columns, 3, "I = 1 + α E, E information gain", is_smooth);
  text += factor_panel(panels, columns, 4, "exp(−λ d), d distance to the view (m)", is_smooth);
  return text + factor_panel(panels, columns, 5, size, is_smooth);
}

/// What the lines and the shades are.
std::vector<KeyEntry> key_of(const std::vector<Phase>& phases, bool is_smooth) {
  std::vector<KeyEntry> key;
  if (is_smooth) {
    key = {{.colour = kPalette[6], .text = "each view", .line = 0.35},
           {.colour = kPalette[6], .text = fmt::format("mean of {} views", kWindow), .line = 1.2}};
  }
  const std::vector<KeyEntry> shades = key_of_phases(phases);
  key.insert(key.end(), shades.begin(), shades.end());
  return key;
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

std::optional<Plot> terms_plot(const RunRecord& record) {
  const std::vector<ViewRecord> views = scored_views(record);
  if (views.empty()) return std::nullopt;
  const UtilityConfig& utility = record.scenario.planner.utility;
  const bool is_eq2 = utility_traits(utility.name).eq2;
  const Eq2 eq2(utility);
  const Columns columns = is_eq2 ? columns_of_eq2(views, eq2) : columns_of(views);
  const bool is_smooth = views.size() > kManyViews;
  const std::size_t count = is_eq2 ? 5 : is_discounted(columns) ? 3 : 1;
  const std::vector<Phase> phases = frontier_phases(record.views);
  Panels panels(count, run_and_seed(record), "views", views_range(record.views),
                key_of(phases, is_smooth));
  std::string text = data_block("raw", rows_of(views, columns, 1)) +
                     data_block("mean", rows_of(views, columns, is_smooth ? kWindow : 1)) +
                     shaded_phases(phases) + utility_panel(panels, columns, is_smooth);
  if (is_eq2) {
    text += quality_panel(panels, columns, eq2);  // one after the other: next() counts
    text += factor_panels(panels, columns, is_smooth);
  } else if (count > 1) {
    text += discount_panels(panels, columns, is_smooth);
  }
  return Plot{"terms", text + "unset multiplot\n", panels.height_px()};
}

}  // namespace gnbv
