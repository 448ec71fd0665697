// Functions of the user's own run in a Python of their own, a child process: $GNBV_PYTHON, or
// python3, which needs NumPy.
#pragma once

#include <memory>

#include "scenarios/scenario.hpp"
#include "tools/mission/user_planner.hpp"

namespace gnbv {

/// Scores by the function. Throws BadInput when Python cannot be started or the source does not
/// define the function. Nothing for utilities of the program, and for planners. The function ends
/// with the thread that starts it, so who asks is to be who started.
UserScores start_user_utility(const UtilityConfig& config);

/// The same, started with the first question.
UserScores lazy_user_utility(const UtilityConfig& config);

/// Plans by the function, which asks the belief through the pipe; what it raises comes as
/// UserUtilityFailed. Throws likewise. Nothing for all that is no planner in a file.
std::unique_ptr<UserPlanner> start_user_planner(const Scenario& scenario, int threads);

}  // namespace gnbv
