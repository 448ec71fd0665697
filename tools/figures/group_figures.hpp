// Figures that set groups of runs beside each other: coverage over effort, how many runs got how
// far, density over the views.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/figures/drawn_groups.hpp"
#include "tools/figures/figure.hpp"

namespace gnbv {

/// "coverage-views", "coverage-metres" or "coverage-seconds": steps for each group, with the 95 %
/// interval of the mean where it has three runs or more; of two both are drawn, thinly. A mark
/// stands where a group's runs end, as a mean over them (the line goes on to the longest), dashes
/// where the paper's row ended and a dark line where the ceiling is, as far as they are known at
/// that size. The axis begins at the tens below all of that. Requires a group whose runs were all
/// scored at the size.
Figure coverage_figure(std::span<const RunGroup> groups, Effort effort, double size_m);

/// Its last 15 %, on axes that just hold it: "coverage-metres-end". A group that ended before is
/// named with its end. Nothing where nobody took any effort.
std::optional<Figure> coverage_end_figure(std::span<const RunGroup> groups, Effort effort,
                                          double size_m);

/// "reach-views", "reach-metres" or "reach-seconds": for each group a step curve, the share of its
/// runs whose cloud covered `share` of the ceiling at 0.05 m by so much effort. A run that ended
/// before never did: the curve then stays below 100 %. (The distribution of run lengths of
/// optimisers: Hoos and Stuetzle 1998; More and Wild 2009, data profiles.) Only runs whose ceiling
/// is known count; nothing when there is none.
std::optional<Figure> reach_figure(std::span<const RunGroup> groups, Effort effort, double share);

/// The densities of missions after each view, the first at 1; one that has ended keeps its own, and
/// one without views is left out. Nothing where all are.
std::optional<DrawnGroup> density_group(std::string label, SeriesLook look,
                                        std::vector<std::vector<double>> missions);

/// "density": a line for each group, drawn as coverage_figure() draws its groups. Requires a group.
Figure mean_density_figure(std::span<const DrawnGroup> groups, std::string_view title);

/// The densities of groups of runs. Nothing where none took a view.
std::optional<Figure> density_figure(std::span<const RunGroup> groups);

}  // namespace gnbv
