// The MAVLink messages that `gnbv fly` speaks, field by field in wire order (common.xml: fields
// sorted by size, extensions last). Names carry the units of the wire; frames are MAVLink's, NED
// and FRD: sim/mavlink/border.hpp converts.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "sim/mavlink/wire.hpp"

namespace gnbv::mavlink {

/// What a receiver must know before it can check a frame. `crc_extra` is the seed that common.xml's
/// definition hashes to; `base_size` counts the fields that MAVLink 1 has, `size` all of them.
struct MessageInfo {
  std::uint32_t id = 0;
  std::uint8_t crc_extra = 0;
  std::uint8_t base_size = 0;
  std::uint8_t size = 0;
};

/// nullptr for a message that is none of those below, of state_messages.hpp or query_messages.hpp.
const MessageInfo* find_message(std::uint32_t id);

struct Heartbeat {
  static constexpr MessageInfo kInfo = {0, 50, 9, 9};
  std::uint32_t custom_mode = 0;   // PX4: main mode << 16 | sub mode << 24
  std::uint8_t type = 0;           // MAV_TYPE
  std::uint8_t autopilot = 0;      // MAV_AUTOPILOT
  std::uint8_t base_mode = 0;      // MAV_MODE_FLAG bits
  std::uint8_t system_status = 0;  // MAV_STATE
  std::uint8_t mavlink_version = 3;
};

struct SetMode {
  static constexpr MessageInfo kInfo = {11, 89, 6, 6};
  std::uint32_t custom_mode = 0;
  std::uint8_t target_system = 0;
  std::uint8_t base_mode = 0;
};

/// Euler angles of the body (FRD) in NED, yaw then pitch then roll; rates about the body axes.
struct Attitude {
  static constexpr MessageInfo kInfo = {30, 39, 28, 28};
  std::uint32_t time_boot_ms = 0;
  float roll_rad = 0;
  float pitch_rad = 0;
  float yaw_rad = 0;
  float roll_speed_rad_s = 0;
  float pitch_speed_rad_s = 0;
  float yaw_speed_rad_s = 0;
};

struct LocalPositionNed {
  static constexpr MessageInfo kInfo = {32, 185, 28, 28};
  std::uint32_t time_boot_ms = 0;
  std::array<float, 3> p_ned_m{};
  std::array<float, 3> v_ned_m_s{};
};

struct CommandLong {
  static constexpr MessageInfo kInfo = {76, 152, 33, 33};
  std::array<float, 7> param{};
  std::uint16_t command = 0;  // MAV_CMD
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
  std::uint8_t confirmation = 0;
};

struct CommandAck {
  static constexpr MessageInfo kInfo = {77, 143, 3, 10};
  std::uint16_t command = 0;  // MAV_CMD
  std::uint8_t result = 0;    // MAV_RESULT
  std::uint8_t progress = 0;
  std::int32_t result_param2 = 0;
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
};

/// Refused; of its fields only the target is of use.
struct SetAttitudeTarget {
  static constexpr MessageInfo kInfo = {82, 49, 39, 51};
  std::array<float, 9> of_no_use{};  // time, quaternion, rates, thrust
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
  std::uint8_t type_mask = 0;
  std::array<float, 3> thrust_body{};
};

/// Refused likewise: the vehicle's places are local.
struct SetPositionTargetGlobalInt {
  static constexpr MessageInfo kInfo = {86, 5, 53, 53};
  std::array<float, 12> of_no_use{};
  std::uint16_t type_mask = 0;
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
  std::uint8_t coordinate_frame = 0;
};

struct SetPositionTargetLocalNed {
  static constexpr MessageInfo kInfo = {84, 143, 53, 53};
  std::uint32_t time_boot_ms = 0;
  std::array<float, 3> p_m{};
  std::array<float, 3> v_m_s{};
  std::array<float, 3> a_m_s2{};
  float yaw_rad = 0;
  float yaw_rate_rad_s = 0;
  std::uint16_t type_mask = 0;  // POSITION_TARGET_TYPEMASK: what to ignore
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
  std::uint8_t coordinate_frame = 0;  // MAV_FRAME
};

/// The defaults say "unknown", each in its field's own way.
struct BatteryStatus {
  static constexpr MessageInfo kInfo = {147, 154, 36, 54};
  std::int32_t current_consumed_mah = -1;
  std::int32_t energy_consumed_hj = -1;
  std::int16_t temperature_cdeg_c = std::numeric_limits<std::int16_t>::max();
  std::array<std::uint16_t, 10> voltages_mv = {0xffff, 0xffff, 0xffff, 0xffff, 0xffff,
                                               0xffff, 0xffff, 0xffff, 0xffff, 0xffff};
  std::int16_t current_ca = -1;
  std::uint8_t id = 0;
  std::uint8_t battery_function = 0;
  std::uint8_t type = 0;
  std::int8_t remaining_percent = -1;
  std::int32_t time_remaining_s = 0;
  std::uint8_t charge_state = 0;
  std::array<std::uint16_t, 4> voltages_ext_mv{};
  std::uint8_t mode = 0;
  std::uint32_t fault_bitmask = 0;
};

struct ExtendedSysState {
  static constexpr MessageInfo kInfo = {245, 130, 2, 2};
  std::uint8_t vtol_state = 0;
  std::uint8_t landed_state = 0;  // MAV_LANDED_STATE: 1 on the ground, 2 in the air
};

/// Text without a NUL when it fills the field. Parts of a longer text share an id and count chunks.
struct StatusText {
  static constexpr MessageInfo kInfo = {253, 83, 51, 54};
  std::uint8_t severity = 6;  // MAV_SEVERITY
  std::array<char, 50> text{};
  std::uint16_t id = 0;
  std::uint8_t chunk_seq = 0;
};

}  // namespace gnbv::mavlink
