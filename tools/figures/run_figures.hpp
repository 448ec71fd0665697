// Figures of one run: what it knew, what its views were worth, what they brought, how it was flown.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

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

/// "flight": position, attitude, speed and, of legs, the distance from them over the time of the
/// views, from trajectory.tum. Nothing for a run without two views, or without its path.
std::optional<Figure> flight_figure(const RunRecord& record);

/// "tracking": over the time of the views, how far the vehicle truly was from the straight legs
/// that were checked for it, beside what the collision radius leaves beyond the hull (the safety
/// margin); and its tilt. Of smooth ways, which no file holds, the tilt alone. Nothing for a run
/// without two views, or without its path.
std::optional<Figure> tracking_figure(const RunRecord& record);

/// A line of yaws in [-180, 180] deg: what goes past 180 is drawn on to 190 before the line breaks
/// (NaN) and goes on at the other end, so that a vehicle that looks that way does not jump to and
/// fro.
Series yaw_series(std::span<const double> times_s, std::span<const double> yaws_deg);

/// Samples over time: as they are, or of many the mean of each of 240 even steps, and a band from
/// that share of its samples to that one.
Series trace(std::string name, const std::vector<double>& times_s,
             const std::vector<double>& values, std::size_t colour, double from = 0.0,
             double to = 1.0);

/// Who flew, and by which seed: the title of a figure of one run.
std::string run_and_seed(const RunRecord& record);

}  // namespace gnbv
