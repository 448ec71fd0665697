#include "tools/figures/run_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tools/figures/curves.hpp"

namespace gnbv {
namespace {

// palette colours on white, as large areas want them
constexpr std::string_view kDensityArea = "#66abd1";
constexpr std::string_view kPredictionArea = "#e69e66";
constexpr std::size_t kManyViews = 100;
constexpr std::size_t kWindow = 15;  // views that a mean is taken over, when there are many

/// How many views were taken with each: on an axis, the first view is 1.
std::vector<double> counts_of(std::span<const ViewRecord> views) {
  std::vector<double> counts;
  for (const ViewRecord& view : views) counts.push_back(view.iteration + 1.0);
  return counts;
}

/// Panels over the views, half a view around them, with the frontier phases shaded.
FigurePanel panel_over_views(const RunRecord& record, std::string heading, Axis y, int height_px) {
  FigurePanel panel{.heading = std::move(heading), .y = std::move(y), .height_px = height_px};
  panel.x =
      axis_from("views", record.views.front().iteration + 0.5, record.views.back().iteration + 1.5);
  for (const Phase& phase : frontier_phases(record.views)) {
    panel.shades.spans.push_back({phase.first + 0.5, phase.last + 1.5});
  }
  return panel;
}

/// The shades are named once, and a panel that stands alone is a tall one.
void finish(Figure& figure) {
  Shades& shades = figure.panels.front().shades;
  if (!shades.spans.empty()) shades.label = "frontier views";
  if (figure.panels.size() == 1) figure.panels.front().height_px = 790;
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

/// The scored views as panels, one below the other.
struct TermPanels {
  const RunRecord& record;
  std::vector<ViewRecord> views;
  int height_px = 0;
  std::vector<FigurePanel> panels = {};

  bool is_smooth() const { return views.size() > kManyViews; }
  std::vector<double> smooth(const std::vector<double>& values) const {
    return moving_mean(values, is_smooth() ? kWindow : 1);
  }

  template <typename Value>
  std::vector<double> column(const Value& value) const {
    std::vector<double> column;
    for (const ViewRecord& view : views) column.push_back(value(view.decision.score));
    return column;
  }

  /// On an axis from 0 that holds all of it that is known.
  FigurePanel& add(std::string heading, std::span<const double> values) {
    double most = 0.0;
    for (const double value : values) most = std::isnan(value) ? most : std::max(most, value);
    panels.push_back(
        panel_over_views(record, std::move(heading), axis_around("", 0.0, most, 3), height_px));
    return panels.back();
  }

  /// Each view behind the means of many; of few as a point, since one may have no neighbours.
  void add_line(std::string heading, const std::string& name, std::size_t colour,
                const std::vector<double>& values) {
    FigurePanel& panel = add(std::move(heading), values);
    Series each{.name = name + ", each view",
                .mark = is_smooth() ? Mark::line : Mark::points,
                .look = {.colour = std::string(kPalette.at(colour))},
                .width_pt = is_smooth() ? 0.3 : 0.0,
                .size_pt = 1.4,
                .opacity = is_smooth() ? 0.35 : 1.0,
                .x = counts_of(views),
                .y = values};
    Series mean{.name = name, .look = each.look, .x = each.x, .y = smooth(values)};
    panel.series = {std::move(each), std::move(mean)};
  }
};

void add_quality(TermPanels& terms, const Eq2& eq2) {
  const auto density = terms.column([&](const Score& s) { return eq2.density(s); });
  const auto prediction = terms.column([&](const Score& s) { return eq2.prediction(s); });
  std::vector<double> quality = density;
  for (std::size_t i = 0; i < quality.size(); ++i) quality[i] += prediction[i];
  // a share of the panel that nobody sees is a number in the heading
  constexpr double kLeastSeen = 0.02;
  const double most = *std::max_element(prediction.begin(), prediction.end());
  const bool is_seen = most > kLeastSeen * *std::max_element(quality.begin(), quality.end());
  std::string heading = eq2.is_normalised ? "Q = (β D + γ P) / (β + γ)" : "Q = β D + γ P";
  if (!is_seen && most == 0.0) heading += ", P = 0";
  if (!is_seen && most > 0.0) heading += fmt::format(", P ≤ {:.2g}", most / eq2.gamma);
  FigurePanel& panel = terms.add(std::move(heading), quality);
  const auto area = [&](std::string name, std::string_view colour, const auto& low,
                        const auto& high) {
    panel.series.push_back({.name = name,
                            .label = name,
                            .mark = Mark::area,
                            .look = {.colour = std::string(colour)},
                            .x = counts_of(terms.views),
                            .y = terms.smooth(high),
                            .low = terms.smooth(low),
                            .high = terms.smooth(high)});
  };
  area("D, density", kDensityArea, std::vector<double>(density.size(), 0.0), density);
  if (is_seen) area("P, prediction", kPredictionArea, density, quality);
}

/// The utility, and the factors that it is the product of.
void add_eq2(TermPanels& terms, const Eq2& eq2) {
  terms.height_px = 205;
  terms.add_line("utility = L Q I exp(−λ d)", "utility", 6,
                 terms.column([](const Score& s) { return s.value; }));
  add_quality(terms, eq2);
  terms.add_line("I = 1 + α E, E information gain", "I", 2,
                 terms.column([&](const Score& s) { return eq2.information(s); }));
  terms.add_line("exp(−λ d), d distance to the view (m)", "exp(−λ d)", 3,
                 terms.column([](const Score& s) { return s.distance; }));
  const auto size = terms.column([&](const Score& s) { return eq2.size(s); });
  const bool is_defined =
      std::none_of(size.begin(), size.end(), [](double value) { return std::isnan(value); });
  terms.add_line(
      fmt::format("L = log₁₀ N, N occupied voxels{}", is_defined ? " in view" : " (where defined)"),
      "L", 4, size);
}

/// The utility, and its gain and distance factor where the latter ever says anything.
void add_gain(TermPanels& terms) {
  terms.height_px = 300;
  terms.add_line("utility", "utility", 6, terms.column([](const Score& s) { return s.value; }));
  const auto distance = terms.column([](const Score& s) { return s.distance; });
  if (std::count(distance.begin(), distance.end(), 1.0) == std::ssize(distance)) return;
  terms.add_line("the product of gain", "gain", 0,
                 terms.column([](const Score& s) { return s.information; }));
  terms.add_line("and distance factor", "distance factor", 3, distance);
}

}  // namespace

std::string run_and_seed(const RunRecord& record) {
  return fmt::format("{}, seed {}", run_title(record), record.scenario.seed);
}

std::optional<Figure> density_entropy_figure(const RunRecord& record, bool has_density) {
  if (record.views.empty()) return std::nullopt;
  constexpr int kHeight_px = 360;
  std::vector<double> entropies, densities;
  for (const ViewRecord& view : record.views) {
    entropies.push_back(view.entropy_nat);
    densities.push_back(view.density_points_per_voxel);
  }
  Figure figure{.name = has_density ? "density" : "entropy",
                .kind = has_density ? "density" : "entropy",
                .title = run_and_seed(record)};
  const std::vector<double> counts = counts_of(record.views);
  const auto add = [&](std::string name, std::string heading, const Axis& y,
                       const std::vector<double>& values, std::size_t colour) {
    figure.panels.push_back(panel_over_views(record, std::move(heading), y, kHeight_px));
    figure.panels.back().series.push_back({.name = std::move(name),
                                           .look = {.colour = std::string(kPalette.at(colour))},
                                           .width_pt = 1.0,
                                           .x = counts,
                                           .y = values,
                                           .end = std::array{counts.back(), values.back()}});
  };
  const auto [low, high] = std::minmax_element(entropies.begin(), entropies.end());
  const Axis entropy = axis_around("", *low, *high);
  add("entropy", entropy.low > 0.0 ? "entropy (nat), axis cut" : "entropy (nat)", entropy,
      entropies, 0);
  if (has_density) {
    add("density", "density (points/voxel)",
        axis_around("", 0.0, *std::max_element(densities.begin(), densities.end())), densities, 1);
  }
  finish(figure);
  return figure;
}

std::optional<Figure> terms_figure(const RunRecord& record) {
  std::vector<ViewRecord> views = scored_views(record);
  if (views.empty()) return std::nullopt;
  TermPanels terms{.record = record, .views = std::move(views)};
  const UtilityConfig& utility = record.scenario.planner.utility;
  if (utility_traits(utility.name).eq2) {
    add_eq2(terms, Eq2(utility));
  } else {
    add_gain(terms);
  }
  Figure figure{.name = "terms", .kind = "terms", .title = run_and_seed(record)};
  figure.panels = std::move(terms.panels);
  if (terms.is_smooth()) {
    figure.notes.push_back(fmt::format("thin: each view; thick: mean of {} views", kWindow));
  }
  finish(figure);
  return figure;
}

}  // namespace gnbv
