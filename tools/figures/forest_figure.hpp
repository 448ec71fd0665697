// Paired differences of methods with their intervals, as reviews of trials draw them.
#pragma once

#include <optional>

#include "bench/compare/comparison.hpp"
#include "tools/figures/figure.hpp"

namespace gnbv {

/// "forest-SCENARIO": for each metric and method that is not the baseline, the mean paired
/// difference to the baseline with its 95 % interval, filled where the signed-rank test rejects
/// after Holm: of shares in percentage points, of all else in percent of the baseline's mean. An
/// interval that would press the others together goes on beyond the axis. Nothing where no
/// difference has an interval.
std::optional<Figure> forest_figure(const Comparison& comparison, std::size_t scenario);

}  // namespace gnbv
