// What to say of a mission that ended before it explored.
#pragma once

#include <string>

#include "tools/run_files/mission_result.hpp"

namespace gnbv {

/// Why the mission ended and what to change, a few lines; empty for one that saw what there was to
/// see, or was to end.
std::string early_end_note(const MissionResult& result);

}  // namespace gnbv
