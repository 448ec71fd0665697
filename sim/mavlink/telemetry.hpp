// The autopilot's own words in MAVLink's: modes, battery, texts. (State: sim/mavlink/border.hpp.)
#pragma once

#include <vector>

#include "sim/flight/px4.hpp"
#include "sim/mavlink/query_messages.hpp"
#include "sim/mavlink/state_messages.hpp"

namespace gnbv::mavlink {

constexpr int kSeverityCritical = 2;  // MAV_SEVERITY

Heartbeat heartbeat_of(const Px4& px4);
ExtendedSysState extended_sys_state_of(const Px4& px4);
/// `battery_wh` 0: never empty, the remaining share is unknown.
BatteryStatus battery_status_of(double energy_used_wh, double battery_wh);
/// All sensors of a quadrotor are there and well: errors of the estimate are not told, as no
/// vehicle knows them. Ready to arm unless in a failsafe.
SysStatus sys_status_of(const Px4& px4, double energy_used_wh, double battery_wh);
/// What it can do of MAVLink, and the PX4 whose rules it follows; "gnbv" in the custom version.
AutopilotVersion autopilot_version();
/// One message for up to 50 characters, and chunks with the same `id` (not 0) for more.
std::vector<StatusText> status_texts_of(const gnbv::StatusText& said, std::uint16_t id);

/// The command that a COMMAND_LONG, a COMMAND_INT (its x and y are of no command we know), or a
/// SET_MODE, stands for.
Px4Command command_of(const CommandLong& message);
Px4Command command_of(const CommandInt& message);
Px4Command command_of(const SetMode& message);

}  // namespace gnbv::mavlink
