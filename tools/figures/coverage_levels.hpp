// What coverage is compared with: the paper's, and the most that a cloud can hold.
#pragma once

#include <span>
#include <vector>

#include "tools/figures/figure.hpp"
#include "tools/figures/groups.hpp"

namespace gnbv {

/// At one voxel size, in percent: the ceilings, which are known at 0.05 m alone, and the final
/// coverage of each of the paper's rows that has a group's scenario, structure and utility. Nothing
/// at a size of which nothing is known.
std::vector<Series> coverage_levels(std::span<const RunGroup> groups, double size_m);

}  // namespace gnbv
