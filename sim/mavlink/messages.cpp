#include "sim/mavlink/messages.hpp"

#include <algorithm>

#include "sim/mavlink/query_messages.hpp"
#include "sim/mavlink/state_messages.hpp"

namespace gnbv::mavlink {
namespace {

template <typename... Messages>
constexpr std::array<MessageInfo, sizeof...(Messages)> infos_of() {
  return {Messages::kInfo...};
}

constexpr auto kMessages =
    infos_of<Heartbeat, SetMode, Attitude, LocalPositionNed, CommandLong, CommandAck,
             SetAttitudeTarget, SetPositionTargetLocalNed, SetPositionTargetGlobalInt,
             BatteryStatus, ExtendedSysState, StatusText,
             // state_messages.hpp
             SysStatus, GpsRawInt, AttitudeQuaternion, GlobalPositionInt, GpsGlobalOrigin, VfrHud,
             HomePosition,
             // query_messages.hpp
             Ping, ParamRequestRead, ParamRequestList, ParamValue, ParamSet, MissionRequest,
             MissionRequestInt, MissionRequestList, MissionCount, MissionClearAll, MissionAck,
             CommandInt, Timesync, AutopilotVersion, MessageInterval, ProtocolVersion>();

}  // namespace

const MessageInfo* find_message(std::uint32_t id) {
  const auto* const found = std::ranges::find(kMessages, id, &MessageInfo::id);
  return found == kMessages.end() ? nullptr : found;
}

}  // namespace gnbv::mavlink
