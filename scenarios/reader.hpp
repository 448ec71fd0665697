// From a tree to the config: what the tree names is set, all else stays.
#pragma once

#include <string>
#include <vector>

#include "scenarios/document.hpp"
#include "scenarios/fields.hpp"

namespace gnbv {

/// Sets what `root` names. Whatever does not fit, unknown keys included, goes to `errors` and
/// changes nothing; where values were given goes to `locations`. Relative paths are taken from
/// `folder`. Angles that are not named become their written_angle_rad(). Returns the keys that
/// version 0.1 had and that were passed over (old_keys.hpp).
std::vector<std::string> read_scenario(const YamlNode& root, const std::string& folder,
                                       Scenario& scenario, ValidationErrors& errors,
                                       SourceLocations& locations);

}  // namespace gnbv
