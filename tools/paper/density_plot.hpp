// Density over the views, of several planners in one picture (the paper's Fig. 9).
#pragma once

#include <span>

#include "tools/paper/comparisons.hpp"
#include "tools/plots/gnuplot.hpp"

namespace gnbv {

/// "density": a line for each series, with the 95 % interval of the mean where several missions
/// reach a view. Requires a series that has a view.
Plot mean_density_plot(std::span<const MeanSeries> series);

}  // namespace gnbv
