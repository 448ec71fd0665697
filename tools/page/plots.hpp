// The plots of a page, as numbers: the page draws them and computes nothing.
#pragma once

#include <vector>

#include "tools/figures/looks.hpp"
#include "tools/page/page_data.hpp"
#include "tools/run/run_record.hpp"

namespace gnbv {

/// Coverage, entropy, density and the terms of the chosen views, over views, metres and seconds.
/// `page` has its runs already, of the same records.
std::vector<page::Plot> plots_of(const std::vector<RunRecord>& records, const page::PageData& page,
                                 const std::vector<std::array<std::optional<double>, 3>>& ceilings,
                                 page::Arrays& arrays);

/// Of each run's lines, by its method.
std::vector<SeriesLook> line_looks(const std::vector<RunRecord>& records);

}  // namespace gnbv
