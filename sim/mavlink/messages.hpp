// The MAVLink messages that `gnbv fly` speaks, field by field in wire order, from common.xml. Names
// carry the units of the wire. Frames are MAVLink's, NED and FRD; sim/mavlink/border.hpp converts.
// Extension fields that are always zero here are left out: MAVLink 2 does not send them.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "sim/mavlink/frame.hpp"

namespace gnbv::mavlink {

/// By latitude and longitude, above mean sea level.
struct GlobalPlace {
  std::int32_t lat_deg_e7, lon_deg_e7, alt_mm;
};

struct Heartbeat {
  static constexpr MessageInfo kInfo = {0, 50, 9, 9};
  std::uint32_t custom_mode = 0;   // PX4: main mode << 16 | sub mode << 24
  std::uint8_t type = 0;           // MAV_TYPE
  std::uint8_t autopilot = 0;      // MAV_AUTOPILOT
  std::uint8_t base_mode = 0;      // MAV_MODE_FLAG bits
  std::uint8_t system_status = 0;  // MAV_STATE
  std::uint8_t mavlink_version = 3;
};

/// The defaults say "unknown" where there is a word for it.
struct SysStatus {
  static constexpr MessageInfo kInfo = {1, 124, 31, 31};
  // MAV_SYS_STATUS_SENSOR bits
  std::uint32_t sensors_present = 0, sensors_enabled = 0, sensors_health = 0;
  std::uint16_t load_permille = 0;
  std::uint16_t voltage_battery_mv = 0xffff;
  std::int16_t current_battery_ca = -1;
  std::uint16_t drop_rate_comm = 0, errors_comm = 0;
  std::array<std::uint16_t, 4> errors_count{};
  std::int8_t battery_remaining_percent = -1;
};

/// Target 0, 0 asks; an answer has the asker as its target.
struct Ping {
  static constexpr MessageInfo kInfo = {4, 237, 14, 14};
  std::uint64_t time_us = 0;
  std::uint32_t seq = 0;
  std::uint8_t target_system = 0, target_component = 0;
};

struct SetMode {
  static constexpr MessageInfo kInfo = {11, 89, 6, 6};
  std::uint32_t custom_mode = 0;
  std::uint8_t target_system = 0;
  std::uint8_t base_mode = 0;
};

/// Without a NUL when it fills the field.
using ParameterId = std::array<char, 16>;

/// By its id when the index is -1.
struct ParamRequestRead {
  static constexpr MessageInfo kInfo = {20, 214, 20, 20};
  std::int16_t param_index = -1;
  std::uint8_t target_system = 0, target_component = 0;
  ParameterId param_id{};
};

struct ParamRequestList {
  static constexpr MessageInfo kInfo = {21, 159, 2, 2};
  std::uint8_t target_system = 0, target_component = 0;
};

/// An integer's bits are carried as they are (PARAM_ENCODE_BYTEWISE).
struct ParamValue {
  static constexpr MessageInfo kInfo = {22, 220, 25, 25};
  float param_value = 0;
  std::uint16_t param_count = 0, param_index = 0;
  ParameterId param_id{};
  std::uint8_t param_type = 0;  // MAV_PARAM_TYPE
};

struct ParamSet {
  static constexpr MessageInfo kInfo = {23, 168, 23, 23};
  float param_value = 0;
  std::uint8_t target_system = 0, target_component = 0;
  ParameterId param_id{};
  std::uint8_t param_type = 0;
};

struct [[gnu::packed]] GpsRawInt {
  static constexpr MessageInfo kInfo = {24, 24, 30, 34};
  std::uint64_t time_us = 0;
  GlobalPlace place{};
  std::uint16_t eph = 0xffff, epv = 0xffff, speed_cm_s = 0xffff, course_cdeg = 0xffff;
  std::uint8_t fix_type = 0;  // GPS_FIX_TYPE: 3 is a 3D fix
  std::uint8_t satellites_visible = 255;
  std::int32_t alt_ellipsoid_mm = 0;
};

/// Euler angles of the body (FRD) in NED, yaw then pitch then roll; rates about the body axes.
struct Attitude {
  static constexpr MessageInfo kInfo = {30, 39, 28, 28};
  std::uint32_t time_boot_ms = 0;
  std::array<float, 3> roll_pitch_yaw_rad{};
  std::array<float, 3> omega_frd_rad_s{};
};

/// Of the FRD body in NED, w first.
struct AttitudeQuaternion {
  static constexpr MessageInfo kInfo = {31, 246, 32, 32};
  std::uint32_t time_boot_ms = 0;
  std::array<float, 4> q_ned_frd{};
  std::array<float, 3> omega_frd_rad_s{};
};

struct LocalPositionNed {
  static constexpr MessageInfo kInfo = {32, 185, 28, 28};
  std::uint32_t time_boot_ms = 0;
  std::array<float, 3> p_ned_m{};
  std::array<float, 3> v_ned_m_s{};
};

struct GlobalPositionInt {
  static constexpr MessageInfo kInfo = {33, 104, 28, 28};
  std::uint32_t time_boot_ms = 0;
  GlobalPlace place{};
  std::int32_t relative_alt_mm = 0;  // above home
  std::array<std::int16_t, 3> v_ned_cm_s{};
  std::uint16_t heading_cdeg = 0;  // from north clockwise, 0 to 35999
};

struct GpsGlobalOrigin {
  static constexpr MessageInfo kInfo = {49, 39, 12, 12};
  GlobalPlace place{};
};

/// x and y: 1e-7 deg, or 1e-4 m; degrees in the floats of old clients.
template <std::uint32_t id, std::uint8_t crc_extra, typename Coordinate>
struct MissionItemIn {
  static constexpr MessageInfo kInfo = {id, crc_extra, 37, 38};
  std::array<float, 4> param{};
  Coordinate x = 0, y = 0;
  float z = 0;
  std::uint16_t seq = 0, command = 0;  // MAV_CMD
  std::uint8_t target_system = 0, target_component = 0;
  std::uint8_t frame = 0, current = 0, autocontinue = 0;  // MAV_FRAME
  std::uint8_t mission_type = 0;
};
using MissionItem = MissionItemIn<39, 254, float>;
using MissionItemInt = MissionItemIn<73, 38, std::int32_t>;

struct MissionSetCurrent {
  static constexpr MessageInfo kInfo = {41, 28, 4, 4};
  std::uint16_t seq = 0;
  std::uint8_t target_system = 0, target_component = 0;
};

struct MissionCurrent {
  static constexpr MessageInfo kInfo = {42, 28, 2, 6};
  std::uint16_t seq = 0;
  std::uint16_t total = 0;  // 65535: there is no mission
  std::uint8_t state = 0;   // MISSION_STATE
  std::uint8_t mode = 0;    // 1 in mission mode, 2 not
};

struct MissionItemReached {
  static constexpr MessageInfo kInfo = {46, 11, 2, 2};
  std::uint16_t seq = 0;
};

/// `number` is an item's, or how many items there are. MAV_MISSION_TYPE: mission, fence, rally.
template <std::uint32_t id, std::uint8_t crc_extra>
struct MissionNumber {
  static constexpr MessageInfo kInfo = {id, crc_extra, 4, 5};
  std::uint16_t number = 0;
  std::uint8_t target_system = 0, target_component = 0;
  std::uint8_t mission_type = 0;
};
using MissionRequest = MissionNumber<40, 230>;
using MissionCount = MissionNumber<44, 221>;
using MissionRequestInt = MissionNumber<51, 196>;

template <std::uint32_t id, std::uint8_t crc_extra>
struct MissionAsWhole {
  static constexpr MessageInfo kInfo = {id, crc_extra, 2, 3};
  std::uint8_t target_system = 0, target_component = 0;
  std::uint8_t mission_type = 0;
};
using MissionRequestList = MissionAsWhole<43, 132>;
using MissionClearAll = MissionAsWhole<45, 232>;

struct MissionAck {
  static constexpr MessageInfo kInfo = {47, 153, 3, 4};
  std::uint8_t target_system = 0, target_component = 0;
  std::uint8_t result = 0;  // MAV_MISSION_RESULT
  std::uint8_t mission_type = 0;
};

struct VfrHud {
  static constexpr MessageInfo kInfo = {74, 20, 20, 20};
  float airspeed_m_s = 0, ground_speed_m_s = 0, alt_m = 0, climb_m_s = 0;
  std::int16_t heading_deg = 0;
  std::uint16_t throttle_percent = 0;
};

/// COMMAND_LONG with a place in integers.
struct CommandInt {
  static constexpr MessageInfo kInfo = {75, 158, 35, 35};
  std::array<float, 4> param{};
  std::int32_t x = 0, y = 0;  // 1e-7 deg, or 1e-4 m
  float z = 0;
  std::uint16_t command = 0;  // MAV_CMD
  std::uint8_t target_system = 0, target_component = 0;
  std::uint8_t frame = 0, current = 0, autocontinue = 0;
};

struct CommandLong {
  static constexpr MessageInfo kInfo = {76, 152, 33, 33};
  std::array<float, 7> param{};
  std::uint16_t command = 0;  // MAV_CMD
  std::uint8_t target_system = 0, target_component = 0;
  std::uint8_t confirmation = 0;
};

struct CommandAck {
  static constexpr MessageInfo kInfo = {77, 143, 3, 10};
  std::uint16_t command = 0;  // MAV_CMD
  std::uint8_t result = 0;    // MAV_RESULT
  std::uint8_t progress = 0;
  std::int32_t result_param2 = 0;
  std::uint8_t target_system = 0, target_component = 0;
};

/// Refused; of its fields only the target is of use.
struct SetAttitudeTarget {
  static constexpr MessageInfo kInfo = {82, 49, 39, 39};
  std::array<float, 9> of_no_use{};  // time, quaternion, rates, thrust
  std::uint8_t target_system = 0, target_component = 0;
  std::uint8_t type_mask = 0;
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
  std::uint8_t target_system = 0, target_component = 0;
  std::uint8_t coordinate_frame = 0;  // MAV_FRAME
};

struct SetPositionTargetGlobalInt {
  static constexpr MessageInfo kInfo = {86, 5, 53, 53};
  std::uint32_t time_boot_ms = 0;
  std::int32_t lat_deg_e7 = 0, lon_deg_e7 = 0;
  float alt_m = 0;
  std::array<float, 3> v_m_s{};
  std::array<float, 3> a_m_s2{};
  float yaw_rad = 0;
  float yaw_rate_rad_s = 0;
  std::uint16_t type_mask = 0;
  std::uint8_t target_system = 0, target_component = 0;
  std::uint8_t coordinate_frame = 0;
};

/// The body's specific force and turning, what a magnetometer and a barometer say.
struct HighresImu {
  static constexpr MessageInfo kInfo = {105, 93, 62, 63};
  std::uint64_t time_us = 0;
  std::array<float, 3> a_frd_m_s2{}, omega_frd_rad_s{}, field_frd_gauss{};
  float pressure_hpa = 0, pressure_difference_hpa = 0, pressure_alt_m = 0, temperature_deg_c = 0;
  std::uint16_t fields_updated = 0x1fff;  // HIGHRES_IMU_UPDATED_FLAGS
  std::uint8_t id = 0;
};

/// A tc1 of 0 asks; the answer has the time there, and the same ts1.
struct Timesync {
  static constexpr MessageInfo kInfo = {111, 34, 16, 18};
  std::int64_t tc1_ns = 0, ts1_ns = 0;
  std::uint8_t target_system = 0, target_component = 0;
};

/// The defaults say "unknown", each in its field's own way.
struct BatteryStatus {
  static constexpr MessageInfo kInfo = {147, 154, 36, 36};
  std::int32_t current_consumed_mah = -1, energy_consumed_hj = -1;
  std::int16_t temperature_cdeg_c = std::numeric_limits<std::int16_t>::max();
  std::array<std::uint16_t, 10> voltages_mv = {0xffff, 0xffff, 0xffff, 0xffff, 0xffff,
                                               0xffff, 0xffff, 0xffff, 0xffff, 0xffff};
  std::int16_t current_ca = -1;
  std::uint8_t id = 0, battery_function = 0, type = 0;
  std::int8_t remaining_percent = -1;
};

struct AutopilotVersion {
  static constexpr MessageInfo kInfo = {148, 178, 60, 60};
  std::uint64_t capabilities = 0;  // MAV_PROTOCOL_CAPABILITY bits
  std::uint64_t uid = 0;
  std::uint32_t flight_sw_version = 0;  // major, minor, patch, FIRMWARE_VERSION_TYPE
  std::uint32_t middleware_sw_version = 0, os_sw_version = 0, board_version = 0;
  std::uint16_t vendor_id = 0, product_id = 0;
  using CustomVersion = std::array<std::uint8_t, 8>;
  CustomVersion flight_custom_version{}, middleware_custom_version{}, os_custom_version{};
};

struct HomePosition {
  static constexpr MessageInfo kInfo = {242, 104, 52, 52};
  GlobalPlace place{};
  std::array<float, 3> p_ned_m{};
  std::array<float, 4> q = {std::numeric_limits<float>::quiet_NaN(), 0, 0, 0};  // NaN: unknown
  std::array<float, 3> approach_ned_m{};
};

struct MessageInterval {
  static constexpr MessageInfo kInfo = {244, 95, 6, 6};
  std::int32_t interval_us = 0;  // -1: not sent, 0: unknown
  std::uint16_t message_id = 0;
};

struct ExtendedSysState {
  static constexpr MessageInfo kInfo = {245, 130, 2, 2};
  std::uint8_t vtol_state = 0;
  // MAV_LANDED_STATE: 1 on the ground, 2 in the air, 3 taking off, 4 landing
  std::uint8_t landed_state = 0;
};

/// Pose in `frame_id`, speeds in `child_frame_id`; a covariance that begins with NaN is unknown.
struct [[gnu::packed]] Odometry {
  static constexpr MessageInfo kInfo = {331, 91, 230, 233};
  std::uint64_t time_us = 0;
  std::array<float, 3> p_m{};
  std::array<float, 4> q{};
  std::array<float, 3> v_m_s{}, omega_rad_s{};
  std::array<float, 21> pose_covariance = {std::numeric_limits<float>::quiet_NaN()};
  std::array<float, 21> velocity_covariance = {std::numeric_limits<float>::quiet_NaN()};
  std::uint8_t frame_id = 1, child_frame_id = 12;      // MAV_FRAME: LOCAL_NED, BODY_FRD
  std::uint8_t reset_counter = 0, estimator_type = 8;  // MAV_ESTIMATOR_TYPE_AUTOPILOT
  std::int8_t quality = 0;
};

/// Text without a NUL when it fills the field. Parts of a longer text share an id and count chunks.
struct [[gnu::packed]] StatusText {
  static constexpr MessageInfo kInfo = {253, 83, 51, 54};
  std::uint8_t severity = 6;  // MAV_SEVERITY
  std::array<char, 50> text{};
  std::uint16_t id = 0;
  std::uint8_t chunk_seq = 0;
};

/// Of component 100. NaN: unknown.
struct CameraInformation {
  static constexpr MessageInfo kInfo = {259, 92, 235, 235};
  std::uint32_t time_boot_ms = 0, firmware_version = 0;
  float focal_length_mm = std::numeric_limits<float>::quiet_NaN();
  float sensor_width_mm = std::numeric_limits<float>::quiet_NaN();
  float sensor_height_mm = std::numeric_limits<float>::quiet_NaN();
  std::uint32_t flags = 0x100;  // CAMERA_CAP_FLAGS_HAS_VIDEO_STREAM
  std::uint16_t width_px = 0, height_px = 0, definition_version = 0;
  std::array<char, 32> vendor{}, model{};
  std::uint8_t lens_id = 0;
  std::array<char, 140> definition_uri{};
};

struct [[gnu::packed]] VideoStreamInformation {
  static constexpr MessageInfo kInfo = {269, 109, 213, 214};
  float rate_hz = 0;
  std::uint32_t bitrate = 0;
  std::uint16_t flags = 1;  // VIDEO_STREAM_STATUS_FLAGS_RUNNING
  std::uint16_t width_px = 0, height_px = 0, rotation_deg = 0, fov_x_deg = 0;
  std::uint8_t stream_id = 1, count = 1;
  std::uint8_t type = 1;  // VIDEO_STREAM_TYPE_RTPUDP, whose uri is a port
  std::array<char, 32> name{};
  std::array<char, 160> uri{};
  std::uint8_t encoding = 1;  // VIDEO_STREAM_ENCODING_H264
};

/// Versions times 100.
struct ProtocolVersion {
  static constexpr MessageInfo kInfo = {300, 217, 22, 22};
  std::uint16_t version = 200, min_version = 100, max_version = 200;
  std::array<std::uint8_t, 8> spec_version_hash{}, library_version_hash{};
};

}  // namespace gnbv::mavlink
