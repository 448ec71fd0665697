// Coverage over effort, of many runs in one picture.
#pragma once

#include <span>
#include <string>

#include "tools/plots/curves.hpp"

namespace gnbv {

/// The body of a gnuplot script, data inline: a line for each group, with the 95 % interval of the
/// mean where it has several runs, and the paper's final coverage dashed where the paper has the
/// group's scenario, structure and utility. `size` is an index of kCoverageSizes_m.
std::string coverage_plot(std::span<const RunGroup> groups, Effort effort, std::size_t size);

}  // namespace gnbv
