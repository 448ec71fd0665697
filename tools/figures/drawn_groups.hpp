// Groups of runs as the series of a panel.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "tools/figures/curves.hpp"
#include "tools/figures/figure.hpp"

namespace gnbv {

constexpr double kGroupWidth_pt = 1.0;

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
  /// "Proposed (2 seeds)"; where a band is drawn, "Proposed (5 seeds), 95 % interval".
  std::string words() const;
};

/// Puts the groups into the panel, those of two seeds thinly behind their means, and what has to be
/// said of them into the notes.
void add_groups(std::span<const DrawnGroup> groups, Mark mark, FigurePanel& panel,
                std::vector<std::string>& notes);

}  // namespace gnbv
