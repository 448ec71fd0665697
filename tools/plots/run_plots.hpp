// Entropy and density of one run over its views.
#pragma once

#include <optional>

#include "tools/plots/gnuplot.hpp"
#include "tools/run/run_record.hpp"

namespace gnbv {

/// "density": entropy and density over the views, each with a mark at its end, phases of frontier
/// views shaded (as the paper's Figs 11, 14 and 17); "entropy": it alone, where another plot has
/// the densities of all runs. Nothing for a run without views.
std::optional<Plot> density_entropy_plot(const RunRecord& record, bool has_density = true);

}  // namespace gnbv
