// Density over the views, of several planners in one picture (the paper's Fig. 9).
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/plots/curves.hpp"
#include "tools/plots/gnuplot.hpp"

namespace gnbv {

/// Density over the views as a mean over seeds. Missions that have ended count no more.
struct MeanSeries {
  std::string label;
  std::string method;  // of method_slots()
  std::vector<MeanEstimate> by_view;
};

/// "density": a line for each series with a mark at its end, and the 95 % interval of the mean
/// where several missions reach a view; the first view is 1. `title` stands beside the key.
/// Requires a series that has a view.
Plot mean_density_plot(std::span<const MeanSeries> series, std::string_view title);

/// The series of groups of runs.
std::vector<MeanSeries> mean_densities(std::span<const RunGroup> groups);

}  // namespace gnbv
