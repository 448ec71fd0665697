// A mission that flies views which a user gave, in a file or through a pipe. For tools/mission/
// only.
#pragma once

#include <optional>

#include "planner/decision.hpp"
#include "planner/termination.hpp"

namespace gnbv {

struct Mission;

bool flies_given(const Mission& m);

/// The next given view that may be flown to; nothing when there is none left. Those that may not
/// are refused, with their reason, and passed over. A resumed mission decides anew, and what it
/// decides has to be what it did: throws BadInput otherwise.
std::optional<Decision> next_given_view(Mission& m);

/// Why there is none left: route_flown, or interrupted.
Termination end_of_given(const Mission& m);

}  // namespace gnbv
