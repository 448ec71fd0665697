// Keys that do nothing in a scenario as it stands: of a sampler, utility or profile not in use.
#pragma once

#include <string>
#include <vector>

#include "scenarios/faults.hpp"
#include "scenarios/scenario.hpp"

namespace gnbv {

/// A key, or a section with all its keys, whose values no mission of the scenario depends on.
struct IdleKey {
  std::string key;
  std::string why;  // which key would have to be another
};

/// All that are known to be idle; what is not listed may still be.
std::vector<IdleKey> idle_keys(const Scenario& scenario);

/// A sentence for each idle key that somebody gave: "key (where) has no effect: why", in the order
/// of the file. What a file gives is passed over where it is the default, and so is a file that
/// gives every key, as `gnbv run` writes it; what an override gives never is.
std::vector<std::string> idle_key_notes(const Scenario& scenario, const Origins& origins);

}  // namespace gnbv
