// Which program flies a mission, beyond its version.
#pragma once

#include <string>

namespace gnbv {

/// SHA-256 over all that a mission's result is made by: the names and contents of the sources of
/// sim, assets, sensors, planner, scenarios, bench and tools/mission, the compiler's version and
/// flags, the versions of the libraries. Found while building (source_id.cmake).
std::string source_id();

}  // namespace gnbv
