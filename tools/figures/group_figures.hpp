// Figures that set groups of runs, or methods, beside each other: coverage over effort, how many
// runs got how far, density over the views, paired differences.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/compare/comparison.hpp"
#include "tools/figures/curves.hpp"
#include "tools/figures/figure.hpp"
#include "tools/figures/groups.hpp"

namespace gnbv {

constexpr int kTallPanel_px = 790;      // one that stands alone
constexpr double kGroupWidth_pt = 1.0;  // of a group's line

/// A group as it is drawn: one curve a run, and their mean.
struct DrawnGroup {
  std::string label;
  SeriesLook look;
  std::vector<StepCurve> curves;
  MeanCurve mean;

  /// Requires a curve.
  DrawnGroup(std::string name, SeriesLook its_look, std::vector<StepCurve> its_curves);

  /// An interval of the mean of fewer than three runs says nothing: their own curves do.
  bool has_band() const { return curves.size() >= 3; }
};

/// Puts the groups into the panel, those of two seeds thinly behind their means, and what has to be
/// said of them into the notes. In the legend "Proposed (2 seeds)"; where a band is drawn,
/// "Proposed (5 seeds), 95 % interval".
void add_groups(std::span<const DrawnGroup> groups, Mark mark, FigurePanel& panel,
                std::vector<std::string>& notes);

/// What coverage is compared with, in percent: the ceilings, which are known at 0.05 m alone, and
/// the final coverage of each of the paper's rows that has a group's scenario, structure and
/// utility. Nothing at a size of which nothing is known.
std::vector<Series> coverage_levels(std::span<const RunGroup> groups, double size_m);

/// "coverage-views" and so on by kEffortNames: steps for each group, with the 95 %
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

/// "reach-views" and so on by kEffortNames: for each group a step curve, the share of its
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

/// "forest-SCENARIO", as reviews of trials draw them: for each metric and method that is not the
/// baseline, the mean paired difference to the baseline with its 95 % interval, filled where the
/// signed-rank test rejects after Holm: of shares in percentage points, of all else in percent of
/// the baseline's mean. An interval that would press the others together goes on beyond the axis.
/// Nothing where no difference has an interval.
std::optional<Figure> forest_figure(const Comparison& comparison, std::size_t scenario);

}  // namespace gnbv
