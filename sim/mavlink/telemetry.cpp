#include "sim/mavlink/telemetry.hpp"

#include <algorithm>
#include <cmath>

namespace gnbv::mavlink {
namespace {

constexpr std::uint8_t kQuadrotor = 2;          // MAV_TYPE
constexpr std::uint8_t kPx4 = 12;               // MAV_AUTOPILOT
constexpr std::uint8_t kCustomModeEnabled = 1;  // MAV_MODE_FLAG
constexpr std::uint8_t kSafetyArmed = 128;
constexpr std::uint8_t kStandby = 3;  // MAV_STATE
constexpr std::uint8_t kActive = 4;
constexpr std::uint8_t kStateCritical = 5;
constexpr std::uint8_t kOnGround = 1;  // MAV_LANDED_STATE
constexpr std::uint8_t kInAir = 2;
constexpr std::uint8_t kLithiumPolymer = 1;  // MAV_BATTERY_TYPE
constexpr std::uint16_t kDoSetMode = 176;    // MAV_CMD

// MAV_SYS_STATUS_SENSOR bits
constexpr std::uint32_t kSensors = 0x1 | 0x2 | 0x4 | 0x8 | 0x20;        // gyro to GPS
constexpr std::uint32_t kControllers = 0x400 | 0x800 | 0x1000 | 0x2000  // rates to height
                                       | 0x4000 | 0x8000;               // place, motors
constexpr std::uint32_t kEstimator = 0x200000;
constexpr std::uint32_t kBattery = 0x2000000;
constexpr std::uint32_t kPrearmCheck = 0x10000000;

// MAV_PROTOCOL_CAPABILITY bits
constexpr std::uint64_t kMissionInt = 4;  // the words for missions; there are none
constexpr std::uint64_t kCommandInt = 8;
constexpr std::uint64_t kParametersBytewise = 16;
constexpr std::uint64_t kLocalTargets = 128;
constexpr std::uint64_t kMavlink2 = 8192;
constexpr std::uint32_t kPx4Version = 1 << 24 | 15 << 16 | 0 << 8 | 255;  // 1.15.0, a release

/// In percent; -1 unknown.
std::int8_t battery_left_percent(double energy_used_wh, double battery_wh) {
  if (battery_wh <= 0.0) return -1;
  const double left = std::clamp(1.0 - energy_used_wh / battery_wh, 0.0, 1.0);
  return static_cast<std::int8_t>(std::lround(100.0 * left));
}

}  // namespace

Heartbeat heartbeat_of(const Px4& px4) {
  const std::uint8_t armed = px4.is_armed() ? kSafetyArmed : 0;
  return {.custom_mode = custom_mode_of(px4.nav_state()),
          .type = kQuadrotor,
          .autopilot = kPx4,
          .base_mode = static_cast<std::uint8_t>(kCustomModeEnabled | armed),
          .system_status = px4.is_in_failsafe() ? kStateCritical
                           : px4.is_armed()     ? kActive
                                                : kStandby};
}

ExtendedSysState extended_sys_state_of(const Px4& px4) {
  return {.landed_state = px4.is_landed() ? kOnGround : kInAir};
}

BatteryStatus battery_status_of(double energy_used_wh, double battery_wh) {
  BatteryStatus status;
  status.type = kLithiumPolymer;
  status.energy_consumed_hj = static_cast<std::int32_t>(std::lround(36.0 * energy_used_wh));
  status.remaining_percent = battery_left_percent(energy_used_wh, battery_wh);
  return status;
}

SysStatus sys_status_of(const Px4& px4, double energy_used_wh, double battery_wh) {
  const std::uint32_t all = kSensors | kControllers | kEstimator | kBattery | kPrearmCheck;
  const bool is_ready = !px4.is_in_failsafe();
  return {.sensors_present = all,
          .sensors_enabled = all,
          .sensors_health = is_ready ? all : all & ~kPrearmCheck,
          .battery_remaining_percent = battery_left_percent(energy_used_wh, battery_wh)};
}

AutopilotVersion autopilot_version() {
  return {
      .capabilities = kMissionInt | kCommandInt | kParametersBytewise | kLocalTargets | kMavlink2,
      .uid = 1,
      .flight_sw_version = kPx4Version,
      .flight_custom_version = {'g', 'n', 'b', 'v'}};
}

std::vector<StatusText> status_texts_of(const gnbv::StatusText& said, std::uint16_t id) {
  const std::size_t width = StatusText{}.text.size();
  const bool is_long = said.text.size() > width;
  std::vector<StatusText> chunks;
  std::size_t begin = 0;
  do {
    StatusText chunk{.severity = static_cast<std::uint8_t>(said.severity),
                     .id = is_long ? id : std::uint16_t{0},
                     .chunk_seq = static_cast<std::uint8_t>(chunks.size())};
    const std::string_view part = std::string_view(said.text).substr(begin, width);
    std::ranges::copy(part, chunk.text.begin());
    chunks.push_back(chunk);
    begin += width;
    // a text is over at its first chunk with a NUL: one that ends with a full chunk needs another
  } while (begin < said.text.size() || (is_long && begin == said.text.size()));
  return chunks;
}

Px4Command command_of(const CommandLong& message) {
  return {.id = message.command, .param = message.param};
}

Px4Command command_of(const CommandInt& message) {
  const auto& p = message.param;
  const float none = std::nanf("");
  return {.id = message.command, .param = {p[0], p[1], p[2], p[3], none, none, message.z}};
}

Px4Command command_of(const SetMode& message) {
  return {.id = kDoSetMode,
          .param = {static_cast<float>(message.base_mode),
                    static_cast<float>(message.custom_mode >> 16 & 0xff),
                    static_cast<float>(message.custom_mode >> 24), 0.0F, 0.0F, 0.0F, 0.0F}};
}

}  // namespace gnbv::mavlink
