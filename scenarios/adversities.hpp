// What contradicts itself in the adversities a scenario names: wind and outages.
#pragma once

#include <vector>

#include "scenarios/problems.hpp"

namespace gnbv {

void check_adversities(const Scenario& scenario, std::vector<Problem>& out);

}  // namespace gnbv
