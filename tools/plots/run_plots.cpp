#include "tools/plots/run_plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "tools/plots/script_parts.hpp"

namespace gnbv {

std::optional<Plot> density_entropy_plot(const RunRecord& record, bool has_density) {
  if (record.views.empty()) return std::nullopt;
  std::vector<double> entropies, densities;
  std::vector<std::vector<double>> rows;
  for (const ViewRecord& view : record.views) {
    entropies.push_back(view.entropy_nat);
    densities.push_back(view.density_points_per_voxel);
    rows.push_back({count_up_to(view), view.entropy_nat, view.density_points_per_voxel});
  }
  const auto [low, high] = std::minmax_element(entropies.begin(), entropies.end());
  const Axis entropy = axis_around(*low, *high);
  const std::vector<Phase> phases = frontier_phases(record.views);
  const std::size_t count = has_density ? 2 : 1;
  Panels panels(count, run_and_seed(record), "views", views_range(record.views));
  std::string text =
      data_block("views", rows) + data_block("end", {rows.back()}) + shaded_phases(phases);
  // the line, and a mark at its end
  const auto plotted = [&](int column, std::size_t colour) {
    return fmt::format(
        "plot $views using 1:{0} with lines lw 1.3 lc rgb '{1}', $end using 1:{0} with points pt 7 "
        "ps 0.5 lc rgb '{1}'\n",
        column, kPalette[colour]);
  };
  text += panels.next(entropy.low > 0.0 ? "entropy (nat), axis cut" : "entropy (nat)",
                      key_of_phases(phases)) +
          axis_settings(entropy) + plotted(2, 0);
  if (has_density) {
    text += panels.next("density (points/voxel)") +
            y_axis(0.0, *std::max_element(densities.begin(), densities.end())) + plotted(3, 1);
  }
  return Plot{has_density ? "density" : "entropy", text + "unset multiplot\n", panels.height_px()};
}

}  // namespace gnbv
