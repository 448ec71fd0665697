#include "sim/mavlink/telemetry.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/mavlink/border.hpp"
#include "sim/mavlink/link.hpp"

namespace gnbv::mavlink {
namespace {

Heartbeat heartbeat(const VehicleReport& report) {
  constexpr std::uint8_t kQuadrotor = 2;          // MAV_TYPE
  constexpr std::uint8_t kPx4 = 12;               // MAV_AUTOPILOT
  constexpr std::uint8_t kCustomModeEnabled = 1;  // MAV_MODE_FLAG
  constexpr std::uint8_t kSafetyArmed = 128;
  constexpr std::uint8_t kStandby = 3, kActive = 4, kStateCritical = 5;  // MAV_STATE
  const Px4& px4 = *report.px4;
  const std::uint8_t armed = px4.is_armed() ? kSafetyArmed : 0;
  return {.custom_mode = custom_mode_of(px4.nav_state()),
          .type = kQuadrotor,
          .autopilot = kPx4,
          .base_mode = static_cast<std::uint8_t>(kCustomModeEnabled | armed),
          .system_status = px4.is_in_failsafe() ? kStateCritical
                           : px4.is_armed()     ? kActive
                                                : kStandby};
}

ExtendedSysState extended_sys_state(const VehicleReport& report) {
  constexpr std::uint8_t kOnGround = 1, kInAir = 2, kTakeoff = 3, kLanding = 4;  // MAV_LANDED_STATE
  const Px4& px4 = *report.px4;
  return {.landed_state = px4.is_landed()       ? kOnGround
                          : px4.is_taking_off() ? kTakeoff
                          : px4.is_landing()    ? kLanding
                                                : kInAir};
}

/// -1: unknown.
std::int8_t battery_left_percent(const VehicleReport& report) {
  if (report.battery_wh <= 0.0) return -1;
  const double left = std::clamp(1.0 - report.energy_wh / report.battery_wh, 0.0, 1.0);
  return static_cast<std::int8_t>(std::lround(100.0 * left));
}

constexpr std::size_t kCells = 4;  // as PX4's simulations have

/// Of one cell, nominal: from BAT1_V_EMPTY to BAT1_V_CHARGED over the charge left.
std::uint16_t cell_mv(const VehicleReport& report) {
  const std::int8_t left_percent = battery_left_percent(report);
  const double left = left_percent < 0 ? 1.0 : 0.01 * left_percent;
  return static_cast<std::uint16_t>(std::lround(std::lerp(3600.0, 4050.0, left)));
}

std::int16_t current_ca(const VehicleReport& report) {
  const double voltage_v = 1e-3 * static_cast<double>(kCells * cell_mv(report));
  return static_cast<std::int16_t>(std::lround(std::min(100.0 * report.power_w / voltage_v, 32e3)));
}

BatteryStatus battery_status(const VehicleReport& report) {
  constexpr std::uint8_t kLithiumPolymer = 1;  // MAV_BATTERY_TYPE
  std::array<std::uint16_t, 10> voltages_mv = BatteryStatus{}.voltages_mv;
  std::fill_n(voltages_mv.begin(), kCells, cell_mv(report));
  return {.energy_consumed_hj = static_cast<std::int32_t>(std::lround(36.0 * report.energy_wh)),
          .voltages_mv = voltages_mv,
          .current_ca = current_ca(report),
          .type = kLithiumPolymer,
          .remaining_percent = battery_left_percent(report)};
}

/// All sensors of a quadrotor are there and well: errors of the estimate are not told, as no
/// vehicle knows them. Ready to arm unless in a failsafe.
SysStatus sys_status(const VehicleReport& report) {
  // MAV_SYS_STATUS_SENSOR bits
  constexpr std::uint32_t kSensors = 0x1 | 0x2 | 0x4 | 0x8 | 0x20;  // gyro to GPS
  constexpr std::uint32_t kControllers =  // rates to height, place, motors
      0x400 | 0x800 | 0x1000 | 0x2000 | 0x4000 | 0x8000;
  constexpr std::uint32_t kEstimator = 0x200000;
  constexpr std::uint32_t kBattery = 0x2000000;
  constexpr std::uint32_t kPrearmCheck = 0x10000000;
  constexpr std::uint32_t kAll = kSensors | kControllers | kEstimator | kBattery | kPrearmCheck;
  return {.sensors_present = kAll,
          .sensors_enabled = kAll,
          .sensors_health = report.px4->is_in_failsafe() ? kAll & ~kPrearmCheck : kAll,
          .voltage_battery_mv = static_cast<std::uint16_t>(kCells * cell_mv(report)),
          .current_battery_ca = current_ca(report),
          .battery_remaining_percent = battery_left_percent(report)};
}

std::array<float, 3> as_floats(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

Attitude attitude(const VehicleReport& report) {
  return {.time_boot_ms = report.time_boot_ms,
          .roll_pitch_yaw_rad = as_floats(roll_pitch_yaw_ned_frd(report.estimate.T_world_body)),
          .omega_frd_rad_s = as_floats(swap_flu_frd(report.estimate.omega_body_rad_s))};
}

/// Of the FRD body in NED.
Eigen::Quaterniond quaternion_of(const VehicleReport& report) {
  const Vec3 angles_rad = roll_pitch_yaw_ned_frd(report.estimate.T_world_body);
  return Eigen::AngleAxisd(angles_rad[2], Vec3::UnitZ()) *
         Eigen::AngleAxisd(angles_rad[1], Vec3::UnitY()) *
         Eigen::AngleAxisd(angles_rad[0], Vec3::UnitX());
}

std::array<float, 4> as_floats(const Eigen::Quaterniond& q) {
  const auto [x, y, z] = as_floats(Vec3(q.vec()));
  return {static_cast<float>(q.w()), x, y, z};
}

AttitudeQuaternion attitude_quaternion(const VehicleReport& report) {
  return {.time_boot_ms = report.time_boot_ms,
          .q_ned_frd = as_floats(quaternion_of(report)),
          .omega_frd_rad_s = as_floats(swap_flu_frd(report.estimate.omega_body_rad_s))};
}

LocalPositionNed local_position(const VehicleReport& report) {
  return {.time_boot_ms = report.time_boot_ms,
          .p_ned_m = as_floats(
              local_of_world(report.estimate.T_world_body.translation(), report.origin_world_m)),
          .v_ned_m_s = as_floats(swap_enu_ned(report.estimate.v_world_m_s))};
}

double positive_deg(double angle_rad) {
  const double angle_deg = rad_to_deg(angle_rad);
  return angle_deg < 0.0 ? angle_deg + 360.0 : angle_deg;
}

/// From north clockwise, in [0, 360).
double heading_deg(const VehicleReport& report) {
  return positive_deg(roll_pitch_yaw_ned_frd(report.estimate.T_world_body)[2]);
}

std::uint16_t centidegrees(double deg) {
  return static_cast<std::uint16_t>(std::lround(100.0 * deg) % 36000);
}

std::int16_t centimetres_per_second(double v_m_s) {
  return static_cast<std::int16_t>(std::lround(std::clamp(100.0 * v_m_s, -32767.0, 32767.0)));
}

GlobalPositionInt global_position(const VehicleReport& report) {
  const GlobalPlace place = place_of(report.estimate.T_world_body.translation());
  const Vec3 v_ned_m_s = swap_enu_ned(report.estimate.v_world_m_s);
  return {
      .time_boot_ms = report.time_boot_ms,
      .place = place,
      .relative_alt_mm = place.alt_mm - static_cast<std::int32_t>(
                                            std::lround(1e3 * report.px4->home_world_m().z())),
      .v_ned_cm_s = {centimetres_per_second(v_ned_m_s.x()), centimetres_per_second(v_ned_m_s.y()),
                     centimetres_per_second(v_ned_m_s.z())},
      .heading_cdeg = centidegrees(heading_deg(report))};
}

/// What a receiver of satellites that makes no errors would say.
GpsRawInt gps_raw(const VehicleReport& report) {
  constexpr std::uint8_t kFix3d = 3;
  constexpr std::uint8_t kSatellites = 12;
  constexpr std::uint16_t kDilution = 70;  // 0.70
  const GlobalPlace place = place_of(report.estimate.T_world_body.translation());
  const Vec3 v_ned_m_s = swap_enu_ned(report.estimate.v_world_m_s);
  return {
      .time_us = std::uint64_t{1000} * report.time_boot_ms,
      .place = place,
      .eph = kDilution,
      .epv = kDilution,
      .speed_cm_s = static_cast<std::uint16_t>(centimetres_per_second(v_ned_m_s.head<2>().norm())),
      .course_cdeg = centidegrees(positive_deg(std::atan2(v_ned_m_s.y(), v_ned_m_s.x()))),
      .fix_type = kFix3d,
      .satellites_visible = kSatellites,
      .alt_ellipsoid_mm = place.alt_mm};
}

VfrHud vfr_hud(const VehicleReport& report) {
  const VehicleState& state = report.estimate;
  const auto speed_m_s = static_cast<float>(state.v_world_m_s.head<2>().norm());
  const double throttle = std::clamp(report.px4->attitude_setpoint().thrust, 0.0, 1.0);
  return {.airspeed_m_s = speed_m_s,
          .ground_speed_m_s = speed_m_s,
          .alt_m = static_cast<float>(state.T_world_body.translation().z()),
          .climb_m_s = static_cast<float>(state.v_world_m_s.z()),
          .heading_deg = static_cast<std::int16_t>(heading_deg(report)),
          .throttle_percent = static_cast<std::uint16_t>(std::lround(100.0 * throttle))};
}

HomePosition home_position(const VehicleReport& report) {
  const Vec3& p_world_m = report.px4->home_world_m();
  return {.place = place_of(p_world_m),
          .p_ned_m = as_floats(local_of_world(p_world_m, report.origin_world_m))};
}

GpsGlobalOrigin global_origin(const VehicleReport& report) {
  return {.place = place_of(report.origin_world_m)};
}

Odometry odometry(const VehicleReport& report) {
  const VehicleState& state = report.estimate;
  return {
      .time_us = std::uint64_t{1000} * report.time_boot_ms,
      .p_m = as_floats(local_of_world(state.T_world_body.translation(), report.origin_world_m)),
      .q = as_floats(quaternion_of(report)),
      .v_m_s = as_floats(swap_flu_frd(state.T_world_body.linear().transpose() * state.v_world_m_s)),
      .omega_rad_s = as_floats(swap_flu_frd(state.omega_body_rad_s))};
}

/// Without noise; the air of the standard atmosphere, the field where PX4's simulations start.
HighresImu highres_imu(const VehicleReport& report) {
  const Vec3 kField_ned_gauss(0.215, 0.012, 0.430);
  const VehicleState& state = report.estimate;
  const double alt_m = state.T_world_body.translation().z();
  const Vec3 field_body = state.T_world_body.linear().transpose() * swap_enu_ned(kField_ned_gauss);
  return {.time_us = std::uint64_t{1000} * report.time_boot_ms,
          .a_frd_m_s2 = as_floats(swap_flu_frd(report.specific_force_body_m_s2)),
          .omega_frd_rad_s = as_floats(swap_flu_frd(state.omega_body_rad_s)),
          .field_frd_gauss = as_floats(swap_flu_frd(field_body)),
          .pressure_hpa = static_cast<float>(1013.25 * std::pow(1.0 - 2.25577e-5 * alt_m, 5.25588)),
          .pressure_alt_m = static_cast<float>(alt_m),
          .temperature_deg_c = static_cast<float>(15.0 - 0.0065 * alt_m)};
}

MissionCurrent mission_current(const VehicleReport& report) {
  constexpr std::uint8_t kNone = 1, kNotStarted = 2, kActive = 3, kPaused = 4, kComplete = 5;
  const Px4& px4 = *report.px4;
  const UploadedMission& mission = px4.mission();
  const std::size_t count = mission.steps.size();
  const bool is_on = px4.nav_state() == NavState::mission;
  return {.seq = static_cast<std::uint16_t>(mission.current),
          .total = static_cast<std::uint16_t>(count == 0 ? 0xffff : count),
          .state = count == 0                ? kNone
                   : mission.is_complete     ? kComplete
                   : is_on && px4.is_armed() ? kActive
                   : mission.current > 0     ? kPaused
                                             : kNotStarted,
          .mode = is_on ? std::uint8_t{1} : std::uint8_t{2}};
}

/// What it can do of MAVLink, and the PX4 whose rules it follows.
AutopilotVersion autopilot_version(const VehicleReport&) {
  // MAV_PROTOCOL_CAPABILITY bits
  constexpr std::uint64_t kMissionFloat = 1, kMissionInt = 4;
  constexpr std::uint64_t kCommandInt = 8;
  constexpr std::uint64_t kParametersBytewise = 16;
  constexpr std::uint64_t kLocalTargets = 128, kGlobalTargets = 256;
  constexpr std::uint64_t kMavlink2 = 8192;
  return {.capabilities = kMissionFloat | kGlobalTargets | kMissionInt | kCommandInt |
                          kParametersBytewise | kLocalTargets | kMavlink2,
          .uid = 1,
          .flight_sw_version = 1 << 24 | 15 << 16 | 0 << 8 | 255,  // 1.15.0, a release
          .flight_custom_version = {'g', 'n', 'b', 'v'}};
}

ProtocolVersion protocol_version(const VehicleReport&) { return {}; }

/// Ends in zeros.
template <std::size_t kSize>
std::array<char, kSize> text(std::string_view from) {
  std::array<char, kSize> to{};
  std::ranges::copy(from.substr(0, kSize - 1), to.begin());
  return to;
}

CameraInformation camera_information(const VehicleReport& report) {
  const VideoStream& video = *report.video;
  return {.time_boot_ms = report.time_boot_ms,
          .width_px = static_cast<std::uint16_t>(video.width_px),
          .height_px = static_cast<std::uint16_t>(video.height_px),
          .vendor = text<32>("gnbv"),
          .model = text<32>(video.camera)};
}

VideoStreamInformation video_stream_information(const VehicleReport& report) {
  const VideoStream& video = *report.video;
  return {.rate_hz = static_cast<float>(video.rate_hz),
          .width_px = static_cast<std::uint16_t>(video.width_px),
          .height_px = static_cast<std::uint16_t>(video.height_px),
          .fov_x_deg = static_cast<std::uint16_t>(std::lround(video.fov_x_deg)),
          .name = text<32>(video.camera),
          .uri = text<160>(std::to_string(video.port))};
}

struct Said {
  std::uint32_t id;
  double interval_s;  // by default; 0: only when asked
  Frame (*pack)(const VehicleReport& report);
};

/// The rates are those of PX4's onboard link (mavlink_main.cpp), or slower.
template <auto message>
constexpr Said said(double default_hz) {
  using Message = decltype(message(std::declval<const VehicleReport&>()));
  return {Message::kInfo.id, default_hz > 0.0 ? 1.0 / default_hz : 0.0,
          [](const VehicleReport& report) { return packed(message(report)); }};
}

constexpr std::array kSaid = {said<heartbeat>(1.0),
                              said<extended_sys_state>(5.0),
                              said<attitude>(50.0),
                              said<local_position>(30.0),
                              said<battery_status>(0.5),
                              said<sys_status>(1.0),
                              said<attitude_quaternion>(50.0),
                              said<global_position>(30.0),
                              said<gps_raw>(1.0),
                              said<vfr_hud>(10.0),
                              said<home_position>(0.5),
                              said<highres_imu>(50.0),
                              said<odometry>(30.0),
                              said<mission_current>(1.0),
                              said<global_origin>(0.0),
                              said<autopilot_version>(0.0),
                              said<protocol_version>(0.0),
                              said<camera_information>(0.0),
                              said<video_stream_information>(0.0)};

}  // namespace

std::optional<Frame> said_of(std::uint32_t id, const VehicleReport& report) {
  const auto* const found = std::ranges::find(kSaid, id, &Said::id);
  if (found == kSaid.end() || (is_cameras(id) && report.video == nullptr)) return std::nullopt;
  Frame frame = found->pack(report);
  frame.component_id = is_cameras(id) ? kCamera : kComponent;
  return frame;
}

bool is_cameras(std::uint32_t id) {
  return id == CameraInformation::kInfo.id || id == VideoStreamInformation::kInfo.id;
}

Frame camera_heartbeat() {
  constexpr std::uint8_t kMavTypeCamera = 30, kNoAutopilot = 8, kActive = 4;
  Frame frame = packed(
      Heartbeat{.type = kMavTypeCamera, .autopilot = kNoAutopilot, .system_status = kActive});
  frame.component_id = kCamera;
  return frame;
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
    std::ranges::copy(std::string_view(said.text).substr(begin, width), chunk.text.begin());
    chunks.push_back(chunk);
    begin += width;
    // a text is over at its first chunk with a NUL: one that ends with a full chunk needs another
  } while (begin < said.text.size() || (is_long && begin == said.text.size()));
  return chunks;
}

Streams::Streams() {
  for (const Said& said : kSaid) streams_[said.id].interval_s = said.interval_s;
}

bool Streams::set_interval_us(std::uint32_t id, float interval_us) {
  const auto* const said = std::ranges::find(kSaid, id, &Said::id);
  if (said == kSaid.end() || !std::isfinite(interval_us)) return false;
  // due at once: the client sees its wish come true, and a slow stream does not hold up a fast one
  streams_[id] = {interval_us == 0.0F  ? said->interval_s
                  : interval_us < 0.0F ? 0.0
                                       : 1e-6 * static_cast<double>(interval_us),
                  0.0};
  return true;
}

std::optional<std::int32_t> Streams::interval_us(std::uint32_t id) const {
  const auto found = streams_.find(id);
  if (found == streams_.end()) return std::nullopt;
  if (found->second.interval_s == 0.0) return -1;
  return static_cast<std::int32_t>(std::min(std::round(1e6 * found->second.interval_s), 2e9));
}

std::vector<std::uint32_t> Streams::take_due(double now_s) {
  std::vector<std::uint32_t> due;
  for (const Said& said : kSaid) {
    Stream& stream = streams_[said.id];
    if (stream.interval_s == 0.0 || now_s < stream.due_s) continue;
    const bool is_late = now_s - stream.due_s >= stream.interval_s;
    stream.due_s = (is_late ? now_s : stream.due_s) + stream.interval_s;
    due.push_back(said.id);
  }
  return due;
}

}  // namespace gnbv::mavlink
