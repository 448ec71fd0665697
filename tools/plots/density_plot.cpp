#include "tools/plots/density_plot.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim/core/error.hpp"
#include "tools/plots/script_parts.hpp"

namespace gnbv {

std::vector<MeanSeries> mean_densities(std::span<const RunGroup> groups) {
  std::vector<MeanSeries> all;
  const std::vector<std::string> methods = methods_of(groups);
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const RunGroup& group = groups[i];
    MeanSeries series{.label = group.label, .method = methods[i], .by_view = {}};
    if (group.runs.size() > 1) series.label += fmt::format(" ({} seeds)", group.runs.size());
    for (std::size_t view = 0;; ++view) {
      std::vector<double> densities;
      for (const RunRecord* const run : group.runs) {
        if (view < run->views.size()) {
          densities.push_back(run->views[view].density_points_per_voxel);
        }
      }
      if (densities.empty()) break;
      series.by_view.push_back(estimate_mean(densities));
    }
    if (!series.by_view.empty()) all.push_back(std::move(series));
  }
  return all;
}

Plot mean_density_plot(std::span<const MeanSeries> series, std::string_view title) {
  std::vector<std::string> methods;
  for (const MeanSeries& each : series) methods.push_back(each.method);
  const std::vector<std::size_t> slots = method_slots(methods);
  std::string data;
  std::string bands;
  std::string lines, ends, names;
  double highest = 0.0;
  std::size_t most_views = 0;
  for (std::size_t i = 0; i < series.size(); ++i) {
    std::vector<std::vector<double>> rows;
    bool has_band = false;
    for (const MeanEstimate& density : series[i].by_view) {
      const double half = density.half_width.value_or(0.0);
      has_band = has_band || density.half_width;
      highest = std::max(highest, density.mean);
      rows.push_back({1.0 + static_cast<double>(rows.size()), density.mean, density.mean - half,
                      density.mean + half});
    }
    most_views = std::max(most_views, rows.size());
    data += data_block(fmt::format("series{}", i), rows) +
            data_block(fmt::format("end{}", i), {rows.back()});
    const std::string_view colour = palette_colour(slots[i]);
    if (has_band) {
      bands += fmt::format(
          "$series{} using 1:3:4 with filledcurves fc rgb '{}' fs transparent solid 0.18 noborder "
          "notitle, ",
          i, colour);
    }
    lines += fmt::format("$series{} using 1:2 with lines lw 1.3 lc rgb '{}' notitle, ", i, colour);
    ends += end_points(fmt::format("end{}", i), slots[i]);
    names +=
        fmt::format("{}keyentry with linespoints lw 1.3 pt {} ps 0.5 lc rgb '{}' title {}",
                    i == 0 ? "" : ", ", end_mark(slots[i]), colour, gnuplot_text(series[i].label));
  }
  GNBV_CHECK(most_views > 0, "no density of {} series", series.size());
  std::size_t entries = series.size();
  if (!bands.empty()) {
    names +=
        ", keyentry with boxes fs solid noborder fc rgb '#d5d9de' title '95 % interval of the "
        "mean'";
    ++entries;
  }
  const auto last = static_cast<double>(most_views);
  const int height_px = height_with_key_px(entries);
  return {"density",
          data + key_above(entries) + title_at_right(title, height_px) +
              y_axis(0.0, 1.15 * highest) +
              fmt::format("set xrange [0:{}] noextend\nset rmargin 3\n", last) +
              x_tics(0.0, last, even_step(last)) +
              "set xlabel 'views'\nset ylabel 'density (points/voxel)' offset 0.6,0\nplot " +
              bands + lines + ends + names + "\n",
          height_px};
}

}  // namespace gnbv
