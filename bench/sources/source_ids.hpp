// Which program made a result, beyond its version.
#pragma once

#include <string>

namespace gnbv {

/// SHA-256 over all that a mission and its score are made by: names and contents of the sources of
/// the rooms that fly one (CMakeLists.txt here lists them, those that score among them), the
/// compiler's version and flags, the versions of the libraries. Found while building
/// (source_id.cmake); tests/bench/sources holds the list against what the compiler read.
std::string flying_source_id();

/// The same of what only scores: references, ceilings, surveys.
std::string scoring_source_id();

}  // namespace gnbv
