// Which figures some runs make, and how a user has them named and coloured.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "tools/figures/figure.hpp"
#include "tools/figures/groups.hpp"

namespace gnbv {

/// The kinds that `gnbv plot --plots` knows.
const std::vector<std::string>& figure_kinds_of_runs();

struct FigureRequest {
  std::vector<std::string> kinds = {"density", "coverage", "terms", "reach"};
  bool has_reach_of_one = false;  // also of a single run, of which it says nothing
  int reach_percent = 95;
  double voxel_m = 0.05;
  std::string title = {};  // in the place of each figure's own
  std::vector<std::string> labels =
      {};  // GROUP=LABEL; a group is named by its label in the legend,
  std::vector<std::string> colours = {};  // its method, or its number from 1; GROUP=#rrggbb
  std::vector<std::string> order = {};    // groups; those that are not named follow
};

/// The figures in their order, with what had to be left out in `notes`, a sentence each. Figures of
/// one run are named after it where there are several. Throws BadInput naming option and value for
/// a group that there is not.
std::vector<Figure> figures_of_runs(std::span<const RunRecord> records,
                                    const FigureRequest& request, std::vector<std::string>& notes);

/// Orders, names and colours the groups as asked for. Throws BadInput as figures_of_runs().
void dress_groups(std::vector<RunGroup>& groups, const FigureRequest& request);

}  // namespace gnbv
