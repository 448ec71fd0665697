// The methods of a sweep file.
#pragma once

#include <filesystem>
#include <vector>

#include "tools/sweep/sweep.hpp"
#include "tools/sweep/sweep_yaml.hpp"

namespace gnbv {

/// Utilities, presets and variants side by side, each at every point of the grid, whose last key
/// changes fastest; "default" where there is neither. A utility may be a function of the user's
/// own, [NAME=]FILE.py[:FUNCTION], beside `folder`. What is wrong goes to the faults of `yaml`.
std::vector<SweepMethod> read_methods(const YamlNode& root, const std::filesystem::path& folder,
                                      SweepYaml& yaml);

}  // namespace gnbv
