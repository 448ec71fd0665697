#include "sim/mavlink/border.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gnbv::mavlink {
namespace {

constexpr std::uint8_t kFrameLocalNed = 1;  // MAV_FRAME
constexpr std::uint8_t kFrameBodyNed = 8;

// POSITION_TARGET_TYPEMASK: what to ignore, and what the acceleration means
constexpr unsigned kIgnoreX = 1;  // y and z in the next bits
constexpr unsigned kIgnoreVx = 8;
constexpr unsigned kIgnoreAx = 64;
constexpr unsigned kForce = 512;
constexpr unsigned kIgnoreYaw = 1024;
constexpr unsigned kIgnoreYawRate = 2048;

// No vehicle is told more, axis by axis. A greater number is garbage, and it would wind up the
// controller's integrals.
constexpr double kPositionMax_m = 1e6;
constexpr double kSpeedMax_m_s = 1e3;
constexpr double kAccelerationMax_m_s2 = 1e3;

constexpr double kNotControlled = std::numeric_limits<double>::quiet_NaN();

double unless_ignored(float value, unsigned type_mask, unsigned bit) {
  return (type_mask & bit) != 0 ? kNotControlled : static_cast<double>(value);
}

/// The three axes, each NaN when its bit is set.
Vec3 unless_ignored(const std::array<float, 3>& v, unsigned type_mask, unsigned first_bit) {
  return {unless_ignored(v[0], type_mask, first_bit),
          unless_ignored(v[1], type_mask, first_bit << 1),
          unless_ignored(v[2], type_mask, first_bit << 2)};
}

std::array<float, 3> as_floats(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

constexpr double kEarthRadius_m = 6371000.0;

struct Place {
  std::int32_t lat_deg_e7 = 0;
  std::int32_t lon_deg_e7 = 0;
  std::int32_t alt_mm = 0;
};

/// On the globe, the scenario's z = 0 at mean sea level.
Place place_of(const Vec3& p_world_m) {
  const double latitude_rad = p_world_m.y() / kEarthRadius_m;
  const double longitude_rad =
      p_world_m.x() / (kEarthRadius_m * std::cos(deg_to_rad(kOriginLatitude_deg)));
  const auto e7 = [](double deg) { return static_cast<std::int32_t>(std::lround(1e7 * deg)); };
  return {e7(kOriginLatitude_deg + rad_to_deg(latitude_rad)),
          e7(kOriginLongitude_deg + rad_to_deg(longitude_rad)),
          static_cast<std::int32_t>(std::lround(1e3 * p_world_m.z()))};
}

/// From north clockwise, in [0, 360).
double heading_deg_of(const VehicleState& state) {
  const double heading_deg = rad_to_deg(euler_ned_frd(state.T_world_body).yaw_rad);
  return heading_deg < 0.0 ? heading_deg + 360.0 : heading_deg;
}

std::uint16_t centidegrees(double deg) {
  return static_cast<std::uint16_t>(std::lround(100.0 * deg) % 36000);
}

std::int16_t centimetres_per_second(double v_m_s) {
  return static_cast<std::int16_t>(std::lround(std::clamp(100.0 * v_m_s, -32767.0, 32767.0)));
}

/// Turned about the vertical; NaN as a whole when one axis is.
Vec3 world_from_level_frd(const Vec3& v_frd, double yaw_world_rad) {
  if (v_frd.hasNaN()) return Vec3::Constant(kNotControlled);
  return Eigen::AngleAxisd(yaw_world_rad, Vec3::UnitZ()) * swap_flu_frd(v_frd);
}

/// Whether a number that is not NaN is beyond its bound.
bool is_out_of_bounds(const Setpoint& s) {
  const auto any = [](const Vec3& v, double limit) { return (v.array().abs() > limit).any(); };
  return any(s.p_world_m, kPositionMax_m) || any(s.v_world_m_s, kSpeedMax_m_s) ||
         any(s.a_world_m_s2, kAccelerationMax_m_s2);
}

bool controls_something(const Setpoint& s) {
  const auto any = [](const Vec3& v) { return !v.array().isNaN().all(); };
  return any(s.p_world_m) || any(s.v_world_m_s) || any(s.a_world_m_s2);
}

}  // namespace

Euler euler_ned_frd(const Isometry& T_world_body) {
  const auto axis_ned = [&](const Vec3& axis_frd) {
    return swap_enu_ned(T_world_body.linear() * swap_flu_frd(axis_frd));
  };
  const Vec3 forward = axis_ned(Vec3::UnitX());
  const double down_of_right = axis_ned(Vec3::UnitY()).z();
  const double down_of_down = axis_ned(Vec3::UnitZ()).z();
  return {.roll_rad = std::atan2(down_of_right, down_of_down),
          .pitch_rad = std::atan2(-forward.z(), std::hypot(forward.x(), forward.y())),
          .yaw_rad = std::atan2(forward.y(), forward.x())};
}

Attitude attitude_of(const VehicleState& state, std::uint32_t time_boot_ms) {
  const Euler euler = euler_ned_frd(state.T_world_body);
  const Vec3 omega_frd_rad_s = swap_flu_frd(state.omega_body_rad_s);
  return {.time_boot_ms = time_boot_ms,
          .roll_rad = static_cast<float>(euler.roll_rad),
          .pitch_rad = static_cast<float>(euler.pitch_rad),
          .yaw_rad = static_cast<float>(euler.yaw_rad),
          .roll_speed_rad_s = static_cast<float>(omega_frd_rad_s.x()),
          .pitch_speed_rad_s = static_cast<float>(omega_frd_rad_s.y()),
          .yaw_speed_rad_s = static_cast<float>(omega_frd_rad_s.z())};
}

LocalPositionNed local_position_of(const VehicleState& state, std::uint32_t time_boot_ms) {
  return {.time_boot_ms = time_boot_ms,
          .p_ned_m = as_floats(swap_enu_ned(state.T_world_body.translation())),
          .v_ned_m_s = as_floats(swap_enu_ned(state.v_world_m_s))};
}

AttitudeQuaternion attitude_quaternion_of(const VehicleState& state, std::uint32_t time_boot_ms) {
  const Euler euler = euler_ned_frd(state.T_world_body);
  const Eigen::Quaterniond q = Eigen::AngleAxisd(euler.yaw_rad, Vec3::UnitZ()) *
                               Eigen::AngleAxisd(euler.pitch_rad, Vec3::UnitY()) *
                               Eigen::AngleAxisd(euler.roll_rad, Vec3::UnitX());
  const auto as_float = [](double x) { return static_cast<float>(x); };
  return {.time_boot_ms = time_boot_ms,
          .q_ned_frd = {as_float(q.w()), as_float(q.x()), as_float(q.y()), as_float(q.z())},
          .omega_frd_rad_s = as_floats(swap_flu_frd(state.omega_body_rad_s))};
}

GpsGlobalOrigin global_origin() {
  const Place origin = place_of(Vec3::Zero());
  return {.lat_deg_e7 = origin.lat_deg_e7, .lon_deg_e7 = origin.lon_deg_e7};
}

GlobalPositionInt global_position_of(const VehicleState& state, std::uint32_t time_boot_ms) {
  const Place place = place_of(state.T_world_body.translation());
  const Vec3 v_ned_m_s = swap_enu_ned(state.v_world_m_s);
  return {
      .time_boot_ms = time_boot_ms,
      .lat_deg_e7 = place.lat_deg_e7,
      .lon_deg_e7 = place.lon_deg_e7,
      .alt_mm = place.alt_mm,
      .relative_alt_mm = place.alt_mm,
      .v_ned_cm_s = {centimetres_per_second(v_ned_m_s.x()), centimetres_per_second(v_ned_m_s.y()),
                     centimetres_per_second(v_ned_m_s.z())},
      .heading_cdeg = centidegrees(heading_deg_of(state))};
}

HomePosition home_position_of(const Eigen::Vector2d& home_world_m) {
  const Vec3 p_world_m(home_world_m.x(), home_world_m.y(), 0.0);
  const Place place = place_of(p_world_m);
  return {.lat_deg_e7 = place.lat_deg_e7,
          .lon_deg_e7 = place.lon_deg_e7,
          .alt_mm = place.alt_mm,
          .p_ned_m = as_floats(swap_enu_ned(p_world_m))};
}

GpsRawInt gps_raw_of(const VehicleState& state, std::uint32_t time_boot_ms) {
  constexpr std::uint8_t kFix3d = 3;
  constexpr std::uint8_t kSatellites = 12;
  constexpr std::uint16_t kDilution = 70;  // 0.70
  const Place place = place_of(state.T_world_body.translation());
  const Vec3 v_ned_m_s = swap_enu_ned(state.v_world_m_s);
  const double course_deg = rad_to_deg(std::atan2(v_ned_m_s.y(), v_ned_m_s.x()));
  return {
      .time_us = std::uint64_t{1000} * time_boot_ms,
      .lat_deg_e7 = place.lat_deg_e7,
      .lon_deg_e7 = place.lon_deg_e7,
      .alt_mm = place.alt_mm,
      .eph = kDilution,
      .epv = kDilution,
      .speed_cm_s = static_cast<std::uint16_t>(centimetres_per_second(v_ned_m_s.head<2>().norm())),
      .course_cdeg = centidegrees(course_deg < 0.0 ? course_deg + 360.0 : course_deg),
      .fix_type = kFix3d,
      .satellites_visible = kSatellites,
      .alt_ellipsoid_mm = place.alt_mm};
}

VfrHud vfr_hud_of(const VehicleState& state, double thrust) {
  const auto speed_m_s = static_cast<float>(state.v_world_m_s.head<2>().norm());
  return {.airspeed_m_s = speed_m_s,
          .ground_speed_m_s = speed_m_s,
          .alt_m = static_cast<float>(state.T_world_body.translation().z()),
          .climb_m_s = static_cast<float>(state.v_world_m_s.z()),
          .heading_deg = static_cast<std::int16_t>(heading_deg_of(state)),
          .throttle_percent =
              static_cast<std::uint16_t>(std::lround(100.0 * std::clamp(thrust, 0.0, 1.0)))};
}

std::variant<Setpoint, Refusal> setpoint_of(const SetPositionTargetLocalNed& message,
                                            double yaw_world_rad) {
  const unsigned mask = message.type_mask;
  if (message.coordinate_frame != kFrameLocalNed && message.coordinate_frame != kFrameBodyNed) {
    return Refusal{fmt::format("setpoint frame {} unsupported", message.coordinate_frame)};
  }
  if ((mask & kForce) != 0) return Refusal{"setpoint of force not supported"};

  const Vec3 v_m_s = unless_ignored(message.v_m_s, mask, kIgnoreVx);
  const Vec3 a_m_s2 = unless_ignored(message.a_m_s2, mask, kIgnoreAx);
  Setpoint setpoint;
  if (message.coordinate_frame == kFrameLocalNed) {
    setpoint.p_world_m = swap_enu_ned(unless_ignored(message.p_m, mask, kIgnoreX));
    setpoint.v_world_m_s = swap_enu_ned(v_m_s);
    setpoint.a_world_m_s2 = swap_enu_ned(a_m_s2);
  } else {
    setpoint.v_world_m_s = world_from_level_frd(v_m_s, yaw_world_rad);
    setpoint.a_world_m_s2 = world_from_level_frd(a_m_s2, yaw_world_rad);
  }
  // angles may be anything finite; of an infinite one wrapping would make NaN, "not controlled"
  const double yaw_ned_rad = unless_ignored(message.yaw_rad, mask, kIgnoreYaw);
  setpoint.yaw_rad = swap_yaw_enu_ned(yaw_ned_rad);
  setpoint.yaw_rate_rad_s = -unless_ignored(message.yaw_rate_rad_s, mask, kIgnoreYawRate);
  if (is_out_of_bounds(setpoint) || std::isinf(yaw_ned_rad) || std::isinf(setpoint.yaw_rate_rad_s))
    return Refusal{"setpoint out of bounds"};
  if (!controls_something(setpoint)) return Refusal{"setpoint invalid: nothing to control"};
  return setpoint;
}

}  // namespace gnbv::mavlink
