// What the views of a tour promised beside what they brought.
#pragma once

#include <optional>

#include "tools/plots/gnuplot.hpp"
#include "tools/run/run_record.hpp"

namespace gnbv {

/// "predictions": above, a dot a view and source of patches, new voxels found over those promised,
/// beside the line where both are equal; below, the shares of what was missing that were found, and
/// promised, by the looks before, a panel an incidence. Nothing for a run without predictions.csv,
/// or an empty one. Throws BadInput as read_predictions_csv().
std::optional<Plot> predictions_plot(const RunRecord& record);

}  // namespace gnbv
