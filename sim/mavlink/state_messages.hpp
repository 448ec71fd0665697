// Telemetry beside that of sim/mavlink/messages.hpp, laid out and named as there: health, place on
// the globe, attitude as a quaternion, home.
#pragma once

#include "sim/mavlink/messages.hpp"

namespace gnbv::mavlink {

/// The defaults say "unknown" where there is a word for it.
struct SysStatus {
  static constexpr MessageInfo kInfo = {1, 124, 31, 43};
  std::uint32_t sensors_present = 0;  // MAV_SYS_STATUS_SENSOR bits, likewise the next two
  std::uint32_t sensors_enabled = 0;
  std::uint32_t sensors_health = 0;
  std::uint16_t load_permille = 0;
  std::uint16_t voltage_battery_mv = std::numeric_limits<std::uint16_t>::max();
  std::int16_t current_battery_ca = -1;
  std::uint16_t drop_rate_comm = 0;
  std::uint16_t errors_comm = 0;
  std::array<std::uint16_t, 4> errors_count{};
  std::int8_t battery_remaining_percent = -1;
  std::array<std::uint32_t, 3> sensors_extended{};
};

struct GpsRawInt {
  static constexpr MessageInfo kInfo = {24, 24, 30, 52};
  std::uint64_t time_us = 0;
  std::int32_t lat_deg_e7 = 0;
  std::int32_t lon_deg_e7 = 0;
  std::int32_t alt_mm = 0;  // above mean sea level
  std::uint16_t eph = std::numeric_limits<std::uint16_t>::max();
  std::uint16_t epv = std::numeric_limits<std::uint16_t>::max();
  std::uint16_t speed_cm_s = std::numeric_limits<std::uint16_t>::max();
  std::uint16_t course_cdeg = std::numeric_limits<std::uint16_t>::max();
  std::uint8_t fix_type = 0;  // GPS_FIX_TYPE: 3 is a 3D fix
  std::uint8_t satellites_visible = 255;
  std::int32_t alt_ellipsoid_mm = 0;
  std::uint32_t h_acc_mm = 0;
  std::uint32_t v_acc_mm = 0;
  std::uint32_t vel_acc_mm_s = 0;
  std::uint32_t heading_acc_deg_e5 = 0;
  std::uint16_t yaw_cdeg = 0;  // 0: not measured
};

/// Of the FRD body in NED, w first.
struct AttitudeQuaternion {
  static constexpr MessageInfo kInfo = {31, 246, 32, 48};
  std::uint32_t time_boot_ms = 0;
  std::array<float, 4> q_ned_frd{};
  std::array<float, 3> omega_frd_rad_s{};
  std::array<float, 4> repr_offset_q{};  // all zeros: none
};

struct GlobalPositionInt {
  static constexpr MessageInfo kInfo = {33, 104, 28, 28};
  std::uint32_t time_boot_ms = 0;
  std::int32_t lat_deg_e7 = 0;
  std::int32_t lon_deg_e7 = 0;
  std::int32_t alt_mm = 0;           // above mean sea level
  std::int32_t relative_alt_mm = 0;  // above home
  std::array<std::int16_t, 3> v_ned_cm_s{};
  std::uint16_t heading_cdeg = 0;  // from north clockwise, 0 to 35999
};

struct GpsGlobalOrigin {
  static constexpr MessageInfo kInfo = {49, 39, 12, 20};
  std::int32_t lat_deg_e7 = 0;
  std::int32_t lon_deg_e7 = 0;
  std::int32_t alt_mm = 0;
  std::uint64_t time_us = 0;
};

struct VfrHud {
  static constexpr MessageInfo kInfo = {74, 20, 20, 20};
  float airspeed_m_s = 0;
  float ground_speed_m_s = 0;
  float alt_m = 0;
  float climb_m_s = 0;
  std::int16_t heading_deg = 0;
  std::uint16_t throttle_percent = 0;
};

struct HomePosition {
  static constexpr MessageInfo kInfo = {242, 104, 52, 60};
  std::int32_t lat_deg_e7 = 0;
  std::int32_t lon_deg_e7 = 0;
  std::int32_t alt_mm = 0;
  std::array<float, 3> p_ned_m{};
  std::array<float, 4> q = {std::numeric_limits<float>::quiet_NaN(), 0, 0, 0};  // NaN: unknown
  std::array<float, 3> approach_ned_m{};
  std::uint64_t time_us = 0;
};

}  // namespace gnbv::mavlink
