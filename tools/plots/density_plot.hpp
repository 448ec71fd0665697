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
  std::vector<std::vector<double>> seeds;  // the densities of each mission
};

/// The mean of missions, those with a view. Requires one at least.
MeanSeries mean_series(std::string label, std::string method,
                       std::vector<std::vector<double>> seeds);

/// "density": a line for each series with a mark at its end, and the 95 % interval of the mean
/// where three missions or more reach a view; of two missions both are drawn, thinly. The first
/// view is 1. Requires a series that has a view.
Plot mean_density_plot(std::span<const MeanSeries> series, std::string_view title);

/// The series of groups of runs.
std::vector<MeanSeries> mean_densities(std::span<const RunGroup> groups);

}  // namespace gnbv
