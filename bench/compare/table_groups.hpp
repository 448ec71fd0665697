// The rows of tables: runs that differ in their seeds alone.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/compare/paper_figures.hpp"
#include "bench/score/run_figures.hpp"

namespace gnbv {

struct TableGroup {
  std::string utility;
  std::string setting;
  std::vector<const RunFigures*> runs = {};

  /// "Proposed, leaf_m=0.07" of the row's name.
  std::string label(const std::string& name) const {
    return setting.empty() ? name : name + ", " + setting;
  }
};

/// In the order of their first runs. `settings` names, for each run, what tells its configuration
/// from others of its utility; none: all runs have the same.
std::vector<TableGroup> table_groups(std::span<const RunFigures> runs,
                                     std::span<const std::string> settings);

/// What the table calls a utility: as the paper does, or by our own words.
std::string name_in_table(const PaperTable& paper, const std::string& utility);

}  // namespace gnbv
