// What is wrong with a scenario whose values are each allowed, but do not go together.
#pragma once

#include <string>
#include <vector>

#include "scenarios/scenario.hpp"

namespace gnbv {

struct Problem {
  std::vector<std::string> keys;  // whose values do not go together, the likeliest culprit first
  std::string what;
};

/// All of them; none for a scenario that can be run.
std::vector<Problem> problems(const Scenario& scenario);

}  // namespace gnbv
