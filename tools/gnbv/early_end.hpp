// What to say of a mission that ended before it explored.
#pragma once

#include <string>

#include "planner/planners.hpp"
#include "tools/run/mission_result.hpp"

namespace gnbv {

/// Why the mission ended and what to change, a few lines; empty for one of 20 views or more, one
/// that covered most of the surface (`coverage` at 0.05 m), and one that was told to end.
std::string early_end_note(const MissionResult& result, double coverage,
                           const PlannerTraits& planner);

/// How many given views were refused, and why, a few lines; empty for none.
std::string refused_views_note(const MissionResult& result);

}  // namespace gnbv
