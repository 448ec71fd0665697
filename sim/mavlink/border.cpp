#include "sim/mavlink/border.hpp"

#include <fmt/format.h>

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

constexpr double kOriginLatitude_deg = 47.397742;
constexpr double kOriginLongitude_deg = 8.545594;
constexpr double kEarthRadius_m = 6371000.0;

constexpr double kSpeedMax_m_s = 1e3;
constexpr double kAccelerationMax_m_s2 = 1e3;

double unless_ignored(float value, unsigned type_mask, unsigned bit) {
  return (type_mask & bit) != 0 ? kNotControlled : static_cast<double>(value);
}

/// The three axes, each NaN when its bit is set.
Vec3 unless_ignored(const std::array<float, 3>& v, unsigned type_mask, unsigned first_bit) {
  return {unless_ignored(v[0], type_mask, first_bit),
          unless_ignored(v[1], type_mask, first_bit << 1),
          unless_ignored(v[2], type_mask, first_bit << 2)};
}

/// Turned about the vertical; NaN as a whole when one axis is.
Vec3 world_from_level_frd(const Vec3& v_frd, double yaw_world_rad) {
  if (v_frd.hasNaN()) return Vec3::Constant(kNotControlled);
  return Eigen::AngleAxisd(yaw_world_rad, Vec3::UnitZ()) * swap_flu_frd(v_frd);
}

/// What is asked of yaw is added, and all of it has to be in bounds and control something.
template <typename Message>
std::variant<Setpoint, Refusal> checked(Setpoint setpoint, const Message& message) {
  if ((message.type_mask & kForce) != 0) return Refusal{"setpoint of force not supported"};
  // an infinite yaw is asked about before it is wrapped: that makes NaN, "not controlled", of it
  const double yaw_ned_rad = unless_ignored(message.yaw_rad, message.type_mask, kIgnoreYaw);
  setpoint.yaw_rad = swap_yaw_enu_ned(yaw_ned_rad);
  setpoint.yaw_rate_rad_s =
      -unless_ignored(message.yaw_rate_rad_s, message.type_mask, kIgnoreYawRate);
  bool is_in_bounds = !std::isinf(yaw_ned_rad) && !std::isinf(setpoint.yaw_rate_rad_s);
  bool controls_something = false;
  const auto check = [&](const Vec3& v, double limit) {
    is_in_bounds &= !(v.array().abs() > limit).any();  // NaN is no number beyond it
    controls_something |= !v.array().isNaN().all();
  };
  check(setpoint.p_world_m, kPositionMax_m);
  check(setpoint.v_world_m_s, kSpeedMax_m_s);
  check(setpoint.a_world_m_s2, kAccelerationMax_m_s2);
  if (!is_in_bounds) return Refusal{"setpoint out of bounds"};
  if (!controls_something) return Refusal{"setpoint invalid: nothing to control"};
  return setpoint;
}

}  // namespace

Vec3 roll_pitch_yaw_ned_frd(const Isometry& T_world_body) {
  const auto axis_ned = [&](const Vec3& axis_frd) {
    return swap_enu_ned(T_world_body.linear() * swap_flu_frd(axis_frd));
  };
  const Vec3 forward = axis_ned(Vec3::UnitX());
  const double down_of_right = axis_ned(Vec3::UnitY()).z();
  const double down_of_down = axis_ned(Vec3::UnitZ()).z();
  return {std::atan2(down_of_right, down_of_down),
          std::atan2(-forward.z(), std::hypot(forward.x(), forward.y())),
          std::atan2(forward.y(), forward.x())};
}

GlobalPlace place_of(const Vec3& p_world_m) {
  const double latitude_rad = p_world_m.y() / kEarthRadius_m;
  const double longitude_rad =
      p_world_m.x() / (kEarthRadius_m * std::cos(deg_to_rad(kOriginLatitude_deg)));
  const auto e7 = [](double deg) { return static_cast<std::int32_t>(std::lround(1e7 * deg)); };
  return {e7(kOriginLatitude_deg + rad_to_deg(latitude_rad)),
          e7(kOriginLongitude_deg + rad_to_deg(longitude_rad)),
          static_cast<std::int32_t>(std::lround(1e3 * p_world_m.z()))};
}

Vec3 world_of_place(double lat_deg, double lon_deg, double alt_m) {
  return {deg_to_rad(lon_deg - kOriginLongitude_deg) * kEarthRadius_m *
              std::cos(deg_to_rad(kOriginLatitude_deg)),
          deg_to_rad(lat_deg - kOriginLatitude_deg) * kEarthRadius_m, alt_m};
}

std::variant<Setpoint, Refusal> setpoint_of(const SetPositionTargetGlobalInt& message,
                                            double home_z_m) {
  const unsigned mask = message.type_mask;
  if (!is_global(message.coordinate_frame)) {
    return Refusal{fmt::format("setpoint frame {} unsupported", message.coordinate_frame)};
  }
  Setpoint setpoint;
  const Vec3 p_world_m =
      world_of_place(1e-7 * message.lat_deg_e7, 1e-7 * message.lon_deg_e7,
                     world_z_of(message.coordinate_frame, message.alt_m, home_z_m));
  const Vec3 ignored = unless_ignored({0.0F, 0.0F, 0.0F}, mask, kIgnoreX);
  setpoint.p_world_m = p_world_m + swap_enu_ned(ignored);  // NaN where it is ignored
  setpoint.v_world_m_s = swap_enu_ned(unless_ignored(message.v_m_s, mask, kIgnoreVx));
  setpoint.a_world_m_s2 = swap_enu_ned(unless_ignored(message.a_m_s2, mask, kIgnoreAx));
  return checked(setpoint, message);
}

std::variant<Setpoint, Refusal> setpoint_of(const SetPositionTargetLocalNed& message,
                                            double yaw_world_rad, const Vec3& origin_world_m) {
  const unsigned mask = message.type_mask;
  if (message.coordinate_frame != kFrameLocalNed && message.coordinate_frame != kFrameBodyNed) {
    return Refusal{fmt::format("setpoint frame {} unsupported", message.coordinate_frame)};
  }
  const Vec3 v_m_s = unless_ignored(message.v_m_s, mask, kIgnoreVx);
  const Vec3 a_m_s2 = unless_ignored(message.a_m_s2, mask, kIgnoreAx);
  Setpoint setpoint;
  if (message.coordinate_frame == kFrameLocalNed) {
    setpoint.p_world_m =
        world_of_local(unless_ignored(message.p_m, mask, kIgnoreX), origin_world_m);
    setpoint.v_world_m_s = swap_enu_ned(v_m_s);
    setpoint.a_world_m_s2 = swap_enu_ned(a_m_s2);
  } else {
    setpoint.v_world_m_s = world_from_level_frd(v_m_s, yaw_world_rad);
    setpoint.a_world_m_s2 = world_from_level_frd(a_m_s2, yaw_world_rad);
  }
  return checked(setpoint, message);
}

}  // namespace gnbv::mavlink
