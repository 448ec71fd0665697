// The methods of a sweep file.
#pragma once

#include <vector>

#include "tools/sweep/sweep.hpp"
#include "tools/sweep/sweep_yaml.hpp"

namespace gnbv {

/// Utilities, presets and variants side by side, each at every point of the grid, whose last key
/// changes fastest; "default" where there is neither. What is wrong goes to the faults of `yaml`.
std::vector<SweepMethod> read_methods(const YamlNode& root, SweepYaml& yaml);

}  // namespace gnbv
