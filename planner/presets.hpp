// The two readings of the method: the paper's, and that of the code its authors released.
#pragma once

#include <array>
#include <string_view>

#include "planner/planner.hpp"

namespace gnbv {

constexpr std::array<std::string_view, 2> kPlannerPresets = {"paper", "released"};

/// Sets every switch in which the two differ (FIDELITY.md lists them) as `config.preset` says, and
/// nothing else: resolution, weights and sizes stay the scenario's. Requires a name of
/// kPlannerPresets.
void set_preset_switches(PlannerConfig& config);

}  // namespace gnbv
