// How many runs got there, over effort.
#pragma once

#include <optional>
#include <span>

#include "tools/plots/curves.hpp"
#include "tools/plots/gnuplot.hpp"

namespace gnbv {

/// "reach-views", "reach-metres" or "reach-seconds": for each group a step curve, the share of its
/// runs whose cloud covered `share` of the ceiling at 0.05 m by so much effort. A run that ended
/// before never did: the curve then stays below 100 %. (The distribution of run lengths of
/// optimisers: Hoos and Stuetzle 1998; More and Wild 2009, data profiles.) Only runs whose ceiling
/// is known count; nothing when there is none.
std::optional<Plot> reach_plot(std::span<const RunGroup> groups, Effort effort, double share);

}  // namespace gnbv
