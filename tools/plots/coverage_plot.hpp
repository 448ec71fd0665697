// Coverage over effort, of many runs in one picture.
#pragma once

#include <optional>
#include <span>

#include "tools/plots/curves.hpp"
#include "tools/plots/gnuplot.hpp"

namespace gnbv {

/// "coverage-views", "coverage-metres" or "coverage-seconds": a line for each group, with the 95 %
/// interval of the mean where it has three runs or more; of two both are drawn, thinly. A mark
/// stands where a group's runs end, as a mean over them (the line goes on to the longest), dashes
/// where the paper's row ended and a dark line where the ceiling is, as far as they are known. The
/// axis begins at the tens below all of that. `size` is an index of kCoverageSizes_m. Requires a
/// group.
Plot coverage_plot(std::span<const RunGroup> groups, Effort effort, std::size_t size);

/// Its last 15 %, on axes that just hold it: "coverage-metres-end". Nothing where all curves end
/// before that.
std::optional<Plot> coverage_end_plot(std::span<const RunGroup> groups, Effort effort,
                                      std::size_t size);

/// The same of runs whose curves hold, in the place of the finest size, the coverage at another.
Plot coverage_plot_at(std::span<const RunGroup> groups, Effort effort, double size_m);

}  // namespace gnbv
