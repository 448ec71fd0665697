// Names and numbers as people read them, on pictures, plots and pages.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "sim/core/text.hpp"

namespace gnbv {

/// Of a scenario, a utility or a preset: "Power plant" for "power_plant", "AEP" for "aep". What is
/// no plain name of ours (lower case, digits, underscores), a file of the user's for one, stays.
std::string human_name(std::string_view name);

/// "1 view", "12 views", "1,200 views".
std::string counted(std::size_t count, std::string_view thing);

/// Where a scale of amounts may end: the least of 1, 2 or 5 times a power of ten that reaches the
/// value, or the greatest that it reaches. Requires one above 0.
double rounded_up_125(double value);
double rounded_down_125(double value);

}  // namespace gnbv
