// What is wrong with the vehicle of a scenario and how it is led. For problems.cpp.
#pragma once

#include <string>
#include <vector>

#include "scenarios/problems.hpp"

namespace gnbv {

/// The two have to be in order; the first key is the smaller one's. Adds a problem if not.
void require_below(double low, double high, const std::string& low_key, const std::string& high_key,
                   std::vector<Problem>& out);

/// Adds what is wrong with vehicle and guidance.
void check_vehicle(const Scenario& scenario, std::vector<Problem>& out);

}  // namespace gnbv
