// Which colour a method has, in plots and in the report.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "tools/run/run_groups.hpp"

namespace gnbv {

/// Of each method a number of its own, the same in whatever company: the paper's three, the tour,
/// the oracles and the released code have theirs. Methods that are not known, and those whose
/// number is taken, get the first ones that are left.
std::vector<std::size_t> method_slots(std::span<const std::string> methods);

/// The method of each run, and of each group, as method_slots() knows them: the utility, or the
/// preset that stands for the released code.
std::vector<std::string> methods_of(std::span<const RunRecord> runs);
std::vector<std::string> methods_of(std::span<const RunGroup> groups);

}  // namespace gnbv
