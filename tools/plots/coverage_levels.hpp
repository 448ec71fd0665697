// What coverage is compared with: the paper's, and the most that a cloud can hold.
#pragma once

#include <span>
#include <vector>

#include "tools/plots/key.hpp"
#include "tools/run/run_groups.hpp"

namespace gnbv {

/// A line over the whole width, and what it is.
struct CoverageLevel {
  double percent = 0.0;
  KeyEntry key;
};

/// The ceilings that are known, and the final coverage of each of the paper's rows that has a
/// group's scenario, structure and utility; it is named where there are several, and apart where
/// its figure is doubtful. `size` is an index of kCoverageSizes_m; ceilings are at the finest.
std::vector<CoverageLevel> coverage_levels(std::span<const RunGroup> groups, std::size_t size);

}  // namespace gnbv
