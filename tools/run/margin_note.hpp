// Whether the room that was checked around each leg was enough for how it was flown.
#pragma once

#include <string>

#include "scenarios/scenario.hpp"
#include "tools/run/mission_result.hpp"

namespace gnbv {

/// A line for a flight that truly was farther from its legs than planner.validity.
/// collision_radius_m leaves beyond the hull, so that only luck kept it from the structure; nothing
/// for others.
std::string margin_note(const Scenario& scenario, const PathError& error);

}  // namespace gnbv
