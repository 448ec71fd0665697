// The plots of one run, named "density" and "terms".
#pragma once

#include <optional>

#include "tools/plots/gnuplot.hpp"
#include "tools/run_files/run_record.hpp"

namespace gnbv {

/// Entropy and density over the iterations, phases of frontier views shaded (as the paper's Figs
/// 11, 14 and 17); entropy alone where another plot has the densities of all runs. Nothing for a
/// run without views.
std::optional<Plot> density_entropy_plot(const RunRecord& record, bool has_density = true);

/// What made the chosen views worth choosing. For `proposed` all factors of Eq. (2): the quality
/// stacked from its density and prediction terms, the information factor 1 + alpha E, the distance
/// factor and the logarithm of the voxels seen; for others gain and distance factor. Of more than
/// 100 views means over 15 are drawn. Nothing for a run whose views nobody scored.
std::optional<Plot> terms_plot(const RunRecord& record);

}  // namespace gnbv
