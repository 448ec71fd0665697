// Parameters without an effect in a scenario as it stands: of a sampler, utility or profile not in
// use.
#pragma once

#include <string>
#include <vector>

#include "scenarios/scenario.hpp"
#include "scenarios/validation_error.hpp"

namespace gnbv {

/// A sentence for each unused parameter that somebody gave: "key (where) has no effect: other key
/// is value", in the order of the file. What a file gives is passed over where it is the default,
/// and so is a file that gives every key, as `gnbv run` writes it; what an override gives never is.
/// Which parameters are unused stands beside them, in fields_*.cpp.
std::vector<std::string> unused_parameter_notes(const Scenario& scenario,
                                                const SourceLocations& locations);

}  // namespace gnbv
