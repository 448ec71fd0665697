#include "tools/plots/density_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "sim/core/error.hpp"
#include "tools/plots/script_parts.hpp"

namespace gnbv {

MeanSeries mean_series(std::string label, std::string method,
                       std::vector<std::vector<double>> seeds) {
  MeanSeries series{.label = std::move(label),
                    .method = std::move(method),
                    .by_view = {},
                    .seeds = std::move(seeds)};
  for (std::size_t view = 0;; ++view) {
    std::vector<double> densities;
    for (const std::vector<double>& seed : series.seeds) {
      if (view < seed.size()) densities.push_back(seed[view]);
    }
    if (densities.empty()) return series;
    series.by_view.push_back(estimate_mean(densities));
  }
}

std::vector<MeanSeries> mean_densities(std::span<const RunGroup> groups) {
  std::vector<MeanSeries> all;
  const std::vector<std::string> methods = methods_of(groups);
  const std::string title = common_scenario(groups);
  for (std::size_t i = 0; i < groups.size(); ++i) {
    std::vector<std::vector<double>> seeds;
    for (const RunRecord* const run : groups[i].runs) {
      seeds.emplace_back();
      for (const ViewRecord& view : run->views) {
        seeds.back().push_back(view.density_points_per_voxel);
      }
    }
    MeanSeries series =
        mean_series(label_below(title, groups[i].label), methods[i], std::move(seeds));
    if (!series.by_view.empty()) all.push_back(std::move(series));
  }
  return all;
}

namespace {

/// The entries of the plot command, and what explains them.
struct DensityLayers {
  std::string data = {}, bands = {}, lines = {}, ends = {};
  std::vector<KeyEntry> key = {};
  double highest = 0.0;
  std::size_t most_views = 0;
};

/// View, mean, low and high of the interval, the last two not known where too few reach the view.
std::vector<std::vector<double>> mean_rows(const MeanSeries& series) {
  std::vector<std::vector<double>> rows;
  for (const MeanEstimate& density : series.by_view) {
    const double half = density.n >= kLeastSeedsOfBand ? density.half_width.value_or(0.0)
                                                       : std::numeric_limits<double>::quiet_NaN();
    rows.push_back({1.0 + static_cast<double>(rows.size()), density.mean, density.mean - half,
                    density.mean + half});
  }
  return rows;
}

void add_series(DensityLayers& layers, const MeanSeries& series, std::size_t i, std::size_t slot) {
  const std::string_view colour = palette_colour(slot);
  const std::vector<std::vector<double>> rows = mean_rows(series);
  for (const auto& row : rows) layers.highest = std::max(layers.highest, row[1]);
  layers.most_views = std::max(layers.most_views, rows.size());
  layers.data += data_block(fmt::format("series{}", i), rows) +
                 data_block(fmt::format("end{}", i), {rows.back()});
  const bool has_band = series.seeds.size() >= kLeastSeedsOfBand;
  if (has_band) {
    layers.bands += fmt::format(
        "$series{} using 1:3:4 with filledcurves fc rgb '{}' fs transparent solid 0.18 noborder, ",
        i, colour);
  }
  for (std::size_t k = 0; series.seeds.size() == 2 && k < 2; ++k) {
    std::vector<std::vector<double>> own;
    for (const double density : series.seeds[k]) {
      own.push_back({1.0 + static_cast<double>(own.size()), density});
      layers.highest = std::max(layers.highest, density);
    }
    if (own.empty()) continue;
    layers.data += data_block(fmt::format("series{}seed{}", i, k), own);
    layers.lines +=
        fmt::format("$series{}seed{} using 1:2 with lines lw 0.5 lc rgb '{}', ", i, k, colour);
  }
  layers.lines += fmt::format("$series{} using 1:2 with lines lw 1.3 dt {} lc rgb '{}', ", i,
                              method_dashes(slot), colour);
  layers.ends += end_points(fmt::format("end{}", i), slot);
  layers.key.push_back({.colour = colour,
                        .text = seeds_label(series.label, series.seeds.size()),
                        .line = 1.3,
                        .dashes = method_dashes(slot),
                        .point = end_mark(slot),
                        .has_band = has_band});
}

}  // namespace

Plot mean_density_plot(std::span<const MeanSeries> series, std::string_view title) {
  std::vector<std::string> methods;
  for (const MeanSeries& each : series) methods.push_back(each.method);
  const std::vector<std::size_t> slots = method_slots(methods);
  DensityLayers layers;
  bool has_seeds = false;
  for (std::size_t i = 0; i < series.size(); ++i) {
    add_series(layers, series[i], i, slots[i]);
    has_seeds = has_seeds || series[i].seeds.size() == 2;
  }
  GNBV_CHECK(layers.most_views > 0, "no density of {} series", series.size());
  if (has_seeds) layers.key.push_back(key_of_seeds());
  const double last = 1.01 * static_cast<double>(layers.most_views);
  std::string entries = layers.bands + layers.lines + layers.ends;
  entries.resize(entries.size() - 2);
  return {"density",
          layers.data + key_above(title, layers.key) + y_axis(0.0, 1.15 * layers.highest) +
              fmt::format("set xrange [0:{}] noextend\nset rmargin 3\n", last) +
              x_tics(0.0, last, even_step(last)) +
              "set xlabel 'views'\nset ylabel 'density (points/voxel)' offset 0.6,0\nplot " +
              entries + "\n",
          height_with_key_px(title, layers.key.size())};
}

}  // namespace gnbv
