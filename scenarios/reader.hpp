// The steps of load_scenario().
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenarios/document.hpp"
#include "scenarios/scenario.hpp"

namespace gnbv {

/// Sets what `root` names; all else stays, but that an angle becomes its written_angle_rad(). What
/// does not fit, unknown keys included, goes to `errors` and changes nothing; where values were
/// given goes to `locations`. Relative paths begin at `folder`. Returns the removed keys that were
/// given, each at its former_default().
std::vector<std::string> read_scenario(const YamlNode& root, const std::string& folder,
                                       Scenario& scenario, ValidationErrors& errors,
                                       SourceLocations& locations);

/// The key of the preset that sets the value of that path, beside or above it: of a vehicle all, of
/// a start the pose, of a sensor all but name and mounting; "" for any other. A planner's preset
/// sets switches alone, and is none of these.
std::string preset_over(std::string_view path);

// ---- the keys of version 0.1 that scenario files have no more (old_keys.cpp): files and run
// directories of that version are read up to version 2.0; then these functions go

/// Whether a key below this path was removed.
bool holds_removed_keys(std::string_view path);
/// The value that a removed key had where nobody gave it, as YAML; nothing for any other path. It
/// may depend on the preset of the scenario's vehicle.
std::optional<std::string> former_default(std::string_view path, const Scenario& scenario);

/// A sentence for each parameter without effect in the scenario as it stands that somebody gave:
/// "key (where) has no effect: other key is value", in the order of the file. Passed over: what a
/// file gives at its default, and a file that gives every key, as `gnbv run` writes it. Which
/// parameters have no effect stands beside them, in fields_*.cpp.
std::vector<std::string> unused_parameter_notes(const Scenario& scenario,
                                                const SourceLocations& locations);

/// What a planner's preset says of the vehicle, unless the user does: authors_2018, no return
/// beyond 5 m (paper_code.md, section 1: Gazebo's default); takeoff, frames at 5 Hz and views
/// passed. And what authors_2018 keeps free, 0.8 m, over a radius that was given before it: under
/// another preset the scenario has its own again.
void set_preset_flight(Scenario& scenario, const SourceLocations& given);

/// A camera with one of its two fields of view given has square pixels.
void set_square_pixels(Scenario& scenario, const SourceLocations& given);

}  // namespace gnbv
