#include "tools/plots/run_plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/plots/gnuplot.hpp"
#include "tools/plots/script_parts.hpp"

namespace gnbv {
namespace {

constexpr std::size_t kManyViews = 100;
constexpr std::size_t kWindow = 15;  // views that a mean is taken over, when there are many

std::string title_of(const RunRecord& record) {
  return fmt::format("{}, seed {}", run_title(record), record.scenario.seed);
}

std::string x_range(const std::vector<ViewRecord>& views) {
  return fmt::format("set xrange [{}:{}]\n", views.front().iteration - 0.5,
                     views.back().iteration + 0.5);
}

/// The views that somebody scored: not the start, nor those of a route.
std::vector<ViewRecord> scored_views(const RunRecord& record) {
  std::vector<ViewRecord> scored;
  std::copy_if(record.views.begin(), record.views.end(), std::back_inserter(scored),
               [](const ViewRecord& view) { return view.decision.score.value != 0.0; });
  return scored;
}

/// Columns, each smoothed, beside the iterations.
std::vector<std::vector<double>> rows_of(const std::vector<ViewRecord>& views,
                                         const std::vector<std::vector<double>>& columns,
                                         std::size_t window) {
  std::vector<std::vector<double>> rows(views.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    rows[i].push_back(static_cast<double>(views[i].iteration));
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
  /// What remains of the value: log10 of the occupied voxels in view, which no file holds.
  double size(const Score& s) const {
    return s.value / (information(s) * (density(s) + prediction(s)) * s.distance);
  }

  double alpha = 0.0;
  double beta = 0.0;
  double gamma = 0.0;
};

std::string line(std::string_view data, int column, std::size_t colour, std::string_view title) {
  return fmt::format("${} using 1:{} with lines lw 1.3 lc rgb '{}' title {}", data, column,
                     kPalette[colour], gnuplot_text(title));
}

/// The single values behind their means, where means are drawn.
std::string raw_line(int column, std::size_t colour, bool is_smooth) {
  if (!is_smooth) return "";
  return fmt::format("$raw using 1:{} with lines lw 0.4 lc rgb '#c8{}' notitle, ", column,
                     kPalette[colour].substr(1));
}

std::string proposed_panels(Panels& panels, const std::vector<Phase>& phases, bool is_smooth) {
  std::string text = panels.next("utility") + "set yrange [0:*]\nplot " +
                     raw_line(2, 6, is_smooth) +
                     line("mean", 2, 6, is_smooth ? "utility, mean over 15 views" : "utility") +
                     key_of_phases(phases) + "\n";
  text += panels.next("quality") + "set key inside top right horizontal\nset yrange [0:1.25]\n";
  text += fmt::format(
      "plot $mean using 1:(0):3 with filledcurves fc rgb '{}' fs solid 0.55 noborder title "
      "'density', $mean using 1:3:($3+$4) with filledcurves fc rgb '{}' fs solid 0.55 noborder "
      "title 'prediction'\n",
      kPalette[0], kPalette[1]);
  text += panels.next("factors") + "set yrange [0:*]\nplot " + raw_line(5, 2, is_smooth) +
          raw_line(6, 3, is_smooth) + line("mean", 5, 2, "information") + ", " +
          line("mean", 6, 3, "distance") + ", " + line("mean", 7, 4, "log10 of voxels seen") + "\n";
  return text;
}

std::string other_panels(Panels& panels, const std::vector<Phase>& phases, bool is_smooth,
                         bool has_distance) {
  std::string text = panels.next("utility") + "set yrange [0:*]\nplot " +
                     raw_line(2, 6, is_smooth) +
                     line("mean", 2, 6, is_smooth ? "chosen view, mean over 15" : "chosen view") +
                     key_of_phases(phases) + "\n";
  if (!has_distance) return text;
  text += panels.next("gain") + "unset key\nset yrange [0:*]\nplot " + raw_line(3, 0, is_smooth) +
          line("mean", 3, 0, "") + "\n";
  return text + panels.next("distance factor") + "set yrange [0:1.05]\nplot " +
         raw_line(4, 3, is_smooth) + line("mean", 4, 3, "") + "\n";
}

}  // namespace

std::optional<std::string> density_entropy_plot(const RunRecord& record) {
  if (record.views.empty()) return std::nullopt;
  std::vector<std::vector<double>> rows;
  double highest_nat = 0.0;
  for (const ViewRecord& view : record.views) {
    rows.push_back(
        {static_cast<double>(view.iteration), view.entropy_nat, view.density_points_per_voxel});
    highest_nat = std::max(highest_nat, view.entropy_nat);
  }
  const bool is_large = highest_nat >= 10'000.0;
  const std::vector<Phase> phases = frontier_phases(record.views);
  Panels panels(2, title_of(record), "iteration");
  std::string text = data_block("views", rows) + x_range(record.views) + shaded_phases(phases) +
                     "set key at screen 0.975,0.965 right top horizontal\n";
  text += panels.next(is_large ? "entropy (1000 nat)" : "entropy (nat)");
  text += fmt::format("plot $views using 1:($2/{}) with lines lw 1.4 lc rgb '{}' notitle{}\n",
                      is_large ? 1000 : 1, kPalette[0], key_of_phases(phases));
  text += panels.next("density (points/voxel)");
  text += fmt::format("plot $views using 1:3 with lines lw 1.4 lc rgb '{}' notitle\n", kPalette[1]);
  return text + "unset multiplot\n";
}

std::optional<std::string> terms_plot(const RunRecord& record) {
  const std::vector<ViewRecord> views = scored_views(record);
  if (views.empty()) return std::nullopt;
  const UtilityConfig& utility = record.scenario.planner.utility;
  const bool is_proposed = utility.name == "proposed";
  std::vector<std::vector<double>> columns = {
      column_of(views, [](const Score& s) { return s.value; })};
  if (is_proposed) {
    const Eq2 eq2(utility);
    columns.push_back(column_of(views, [&](const Score& s) { return eq2.density(s); }));
    columns.push_back(column_of(views, [&](const Score& s) { return eq2.prediction(s); }));
    columns.push_back(column_of(views, [&](const Score& s) { return eq2.information(s); }));
    columns.push_back(column_of(views, [](const Score& s) { return s.distance; }));
    columns.push_back(column_of(views, [&](const Score& s) { return eq2.size(s); }));
  } else {
    columns.push_back(column_of(views, [](const Score& s) { return s.information; }));
    columns.push_back(column_of(views, [](const Score& s) { return s.distance; }));
  }
  const bool has_distance = std::any_of(views.begin(), views.end(), [](const ViewRecord& view) {
    return view.decision.score.distance != 1.0;
  });
  const bool is_smooth = views.size() > kManyViews;
  const std::vector<Phase> phases = frontier_phases(record.views);
  Panels panels(is_proposed || has_distance ? 3 : 1, title_of(record), "iteration");
  return data_block("raw", rows_of(views, columns, 1)) +
         data_block("mean", rows_of(views, columns, is_smooth ? kWindow : 1)) +
         x_range(record.views) + shaded_phases(phases) +
         "set key at screen 0.975,0.965 right top horizontal\n" +
         (is_proposed ? proposed_panels(panels, phases, is_smooth)
                      : other_panels(panels, phases, is_smooth, has_distance)) +
         "unset multiplot\n";
}

}  // namespace gnbv
