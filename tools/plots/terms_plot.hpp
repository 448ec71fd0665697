// What made the chosen views of one run worth choosing.
#pragma once

#include <optional>

#include "tools/plots/gnuplot.hpp"
#include "tools/run/run_record.hpp"

namespace gnbv {

/// "terms": for `proposed` all factors of Eq. (2), each in a panel with its formula: the quality
/// stacked from its density and prediction terms, the information factor 1 + alpha E, the distance
/// factor and the logarithm of the voxels seen; for others gain and distance factor. Of more than
/// 100 views means over 15 are drawn, too. Nothing for a run whose views nobody scored.
std::optional<Plot> terms_plot(const RunRecord& record);

}  // namespace gnbv
