// The keys of version 0.1 that scenario files have no more. Files and run directories of that
// version are read up to version 2.0; then this file goes.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "scenarios/scenario.hpp"

namespace gnbv {

/// The last part of the name that today's key, given by its path, had in version 0.1; empty where
/// it had the same. A renamed key stays in its section.
std::string_view old_name_of(std::string_view path);

/// Whether a key below this path was removed.
bool holds_removed_keys(std::string_view path);

/// The value that a removed key had where nobody gave it, as YAML; nothing for any other path. It
/// may depend on the preset of the scenario's vehicle.
std::optional<std::string> former_default(std::string_view path, const Scenario& scenario);

}  // namespace gnbv
