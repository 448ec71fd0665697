// The messages by which a client asks at connection, and their answers: commands with integers,
// parameters, missions, time, versions. Layout and names as in sim/mavlink/messages.hpp.
#pragma once

#include "sim/mavlink/messages.hpp"

namespace gnbv::mavlink {

/// Target 0, 0 asks; an answer has the asker as its target.
struct Ping {
  static constexpr MessageInfo kInfo = {4, 237, 14, 14};
  std::uint64_t time_us = 0;
  std::uint32_t seq = 0;
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
};

/// Without a NUL when it fills the field.
using ParameterId = std::array<char, 16>;

/// By its id when the index is -1.
struct ParamRequestRead {
  static constexpr MessageInfo kInfo = {20, 214, 20, 20};
  std::int16_t param_index = -1;
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
  ParameterId param_id{};
};

struct ParamRequestList {
  static constexpr MessageInfo kInfo = {21, 159, 2, 2};
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
};

/// An integer's bits are carried as they are (PARAM_ENCODE_BYTEWISE).
struct ParamValue {
  static constexpr MessageInfo kInfo = {22, 220, 25, 25};
  float param_value = 0;
  std::uint16_t param_count = 0;
  std::uint16_t param_index = 0;
  ParameterId param_id{};
  std::uint8_t param_type = 0;  // MAV_PARAM_TYPE
};

struct ParamSet {
  static constexpr MessageInfo kInfo = {23, 168, 23, 23};
  float param_value = 0;
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
  ParameterId param_id{};
  std::uint8_t param_type = 0;
};

template <std::uint32_t id, std::uint8_t crc_extra>
struct AnyMissionRequest {
  static constexpr MessageInfo kInfo = {id, crc_extra, 4, 5};
  std::uint16_t seq = 0;
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
  std::uint8_t mission_type = 0;  // MAV_MISSION_TYPE: mission, fence, rally points
};
using MissionRequest = AnyMissionRequest<40, 230>;
using MissionRequestInt = AnyMissionRequest<51, 196>;

struct MissionRequestList {
  static constexpr MessageInfo kInfo = {43, 132, 2, 3};
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
  std::uint8_t mission_type = 0;
};

struct MissionCount {
  static constexpr MessageInfo kInfo = {44, 221, 4, 5};
  std::uint16_t count = 0;
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
  std::uint8_t mission_type = 0;
};

struct MissionClearAll {
  static constexpr MessageInfo kInfo = {45, 232, 2, 3};
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
  std::uint8_t mission_type = 0;
};

struct MissionAck {
  static constexpr MessageInfo kInfo = {47, 153, 3, 4};
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
  std::uint8_t result = 0;  // MAV_MISSION_RESULT
  std::uint8_t mission_type = 0;
};

/// COMMAND_LONG with a place in integers.
struct CommandInt {
  static constexpr MessageInfo kInfo = {75, 158, 35, 35};
  std::array<float, 4> param{};
  std::int32_t x = 0;  // 1e-7 deg, or 1e-4 m
  std::int32_t y = 0;
  float z = 0;
  std::uint16_t command = 0;
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
  std::uint8_t frame = 0;
  std::uint8_t current = 0;
  std::uint8_t autocontinue = 0;
};

/// A tc1 of 0 asks; the answer has the time there, and the same ts1.
struct Timesync {
  static constexpr MessageInfo kInfo = {111, 34, 16, 18};
  std::int64_t tc1_ns = 0;
  std::int64_t ts1_ns = 0;
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
};

struct AutopilotVersion {
  static constexpr MessageInfo kInfo = {148, 178, 60, 78};
  std::uint64_t capabilities = 0;  // MAV_PROTOCOL_CAPABILITY bits
  std::uint64_t uid = 0;
  std::uint32_t flight_sw_version = 0;  // major, minor, patch, FIRMWARE_VERSION_TYPE
  std::uint32_t middleware_sw_version = 0;
  std::uint32_t os_sw_version = 0;
  std::uint32_t board_version = 0;
  std::uint16_t vendor_id = 0;
  std::uint16_t product_id = 0;
  std::array<std::uint8_t, 8> flight_custom_version{};
  std::array<std::uint8_t, 8> middleware_custom_version{};
  std::array<std::uint8_t, 8> os_custom_version{};
  std::array<std::uint8_t, 18> uid2{};
};

struct MessageInterval {
  static constexpr MessageInfo kInfo = {244, 95, 6, 6};
  std::int32_t interval_us = 0;  // -1: not sent, 0: unknown
  std::uint16_t message_id = 0;
};

/// Versions times 100.
struct ProtocolVersion {
  static constexpr MessageInfo kInfo = {300, 217, 22, 22};
  std::uint16_t version = 200;
  std::uint16_t min_version = 100;
  std::uint16_t max_version = 200;
  std::array<std::uint8_t, 8> spec_version_hash{};
  std::array<std::uint8_t, 8> library_version_hash{};
};

}  // namespace gnbv::mavlink
