// What --utilities, --presets, --variant and --vary name, as methods to compare.
#pragma once

#include <string>
#include <vector>

#include "tools/sweep/sweep.hpp"

namespace gnbv {

struct MethodOptions {
  std::vector<std::string> utilities{};
  std::vector<std::string> presets{};
  std::vector<std::string> variants{};  // [NAME:]KEY=VALUE[,KEY=VALUE]...
  std::vector<std::string> varies{};    // KEY=VALUE[,VALUE]...: a method a value
};

/// Each a utility by name, or a utility or planner [NAME=]FILE.py[:FUNCTION], named as shortly as
/// tells them apart. Throws BadInput for a file that defines none.
std::vector<SweepMethod> methods_of_utilities(const std::vector<std::string>& utilities);

/// In the order of the options above: a utility is named as above, a preset as it is, a variant by
/// its NAME or its text, a varied value by KEY=VALUE. When only variants are named, the scenario as
/// it is, "default", stands first. Commas within brackets, braces or quotes separate nothing.
/// Throws BadInput with every fault at once: text that is none of this, a name that stands twice,
/// a seed, fewer than two methods. Keys and values are checked by cells_of().
std::vector<SweepMethod> methods_of(const MethodOptions& options);

}  // namespace gnbv
