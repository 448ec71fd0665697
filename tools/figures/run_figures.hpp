// Figures of one run: what it knew, what its views were worth, what they brought.
#pragma once

#include <optional>

#include "tools/figures/figure.hpp"
#include "tools/run/run_record.hpp"

namespace gnbv {

/// "density": entropy and density over the views, phases of frontier views shaded (as the paper's
/// Figs 11, 14 and 17); "entropy": it alone, where another figure has the densities of all runs.
/// Nothing for a run without views.
std::optional<Figure> density_entropy_figure(const RunRecord& record, bool has_density = true);

/// "terms": for `proposed` all factors of Eq. (2), each in a panel with its formula: the quality
/// stacked from its density and prediction terms, the information factor 1 + alpha E, the distance
/// factor and the logarithm of the voxels seen; for others gain and distance factor. Of more than
/// 100 views means over 15 are drawn, too. Nothing for a run whose views nobody scored.
std::optional<Figure> terms_figure(const RunRecord& record);

/// "predictions": above, a dot a view and source of patches, new voxels found over those promised,
/// beside the line where both are equal; below, the shares of what was missing that were found, and
/// promised, by the looks before, a panel an incidence. Nothing for a run without predictions.csv,
/// or an empty one. Throws BadInput as read_predictions_csv().
std::optional<Figure> predictions_figure(const RunRecord& record);

/// Who flew, and by which seed: the title of a figure of one run.
std::string run_and_seed(const RunRecord& record);

}  // namespace gnbv
