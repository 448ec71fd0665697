// The autopilot's parameters by PX4's names.
#pragma once

#include <cstdint>
#include <optional>

#include "sim/flight/commander_parameters.hpp"
#include "sim/mavlink/query_messages.hpp"

namespace gnbv::mavlink {

/// nullopt beyond the last.
std::optional<ParamValue> parameter_at(const CommanderParameters& commander, int index);
std::optional<int> find_parameter(const ParameterId& id);
/// Whether it may be so (type, range); if it may, it is.
bool set_parameter(CommanderParameters& commander, int index, const ParamSet& message);

}  // namespace gnbv::mavlink
