// The one border between our frames (world ENU, body FLU) and MAVLink's (NED, FRD): north is world
// y, east world x. The local origin is given; the globe's place of the world's never changes.
#pragma once

#include <string>
#include <variant>

#include "sim/flight/flight.hpp"
#include "sim/mavlink/messages.hpp"

namespace gnbv::mavlink {

/// ENU to NED; its own inverse.
inline Vec3 swap_enu_ned(const Vec3& v) { return {v.y(), v.x(), -v.z()}; }
/// From the local frame at that origin to the world, and back.
inline Vec3 world_of_local(const Vec3& p_ned_m, const Vec3& origin_world_m) {
  return origin_world_m + swap_enu_ned(p_ned_m);
}
inline Vec3 local_of_world(const Vec3& p_world_m, const Vec3& origin_world_m) {
  return swap_enu_ned(p_world_m - origin_world_m);
}

/// On the globe. The world's origin lies where PX4's own simulations start, at mean sea level. On a
/// sphere of 6371 km, as PX4 projects, in steps of 1e-7 deg (11 mm).
GlobalPlace place_of(const Vec3& p_world_m);
/// The reverse, of degrees and metres; NaN stays NaN.
Vec3 world_of_place(double lat_deg, double lon_deg, double alt_m);

/// FLU to FRD; its own inverse.
inline Vec3 swap_flu_frd(const Vec3& v) { return {v.x(), -v.y(), -v.z()}; }
/// Heading from east counter-clockwise to heading from north clockwise, in (-pi, pi]; its own
/// inverse.
inline double swap_yaw_enu_ned(double yaw_rad) { return wrap_angle_rad(kPi / 2.0 - yaw_rad); }

/// Roll, pitch and yaw of the FRD body in NED: R = Rz(yaw) Ry(pitch) Rx(roll), pitch in
/// [-pi/2, pi/2].
Vec3 roll_pitch_yaw_ned_frd(const Isometry& T_world_body);

/// Why a setpoint is not flown: one sentence for the client.
struct Refusal {
  std::string reason;
};

/// The setpoint that the message asks for, as PX4's mavlink_receiver.cpp reads it: a field that is
/// ignored by the type mask, or NaN, is not controlled. LOCAL_NED (1) is taken as it is; BODY_NED
/// (8) turns velocity and acceleration by the heading, each only when none of its axes is ignored,
/// and has no position. Refused: other frames, the force bit, a world axis beyond 1e6 m, 1e3 m/s or
/// 1e3 m/s^2, an infinite yaw or yaw rate, nothing left to control.
std::variant<Setpoint, Refusal> setpoint_of(const SetPositionTargetLocalNed& message,
                                            double yaw_world_rad,
                                            const Vec3& origin_world_m = Vec3::Zero());
/// The same with a place on the globe (frames 0, 3, 5, 6).
std::variant<Setpoint, Refusal> setpoint_of(const SetPositionTargetGlobalInt& message,
                                            double home_z_m);

/// Each axis at most. A greater number is garbage, and would wind up the controller's integrals.
constexpr double kPositionMax_m = 1e6;
inline bool is_in_bounds(const Vec3& p_m) { return !(p_m.array().abs() > kPositionMax_m).any(); }

/// Of an integer coordinate that leaves open where.
constexpr std::int32_t kNoCoordinate = std::numeric_limits<std::int32_t>::max();
/// MAV_FRAME: on the globe above the sea or above home, in floats or integers.
constexpr bool is_global(std::uint8_t frame) {
  return frame == 0 || frame == 3 || frame == 5 || frame == 6;
}
constexpr bool is_above_home(std::uint8_t frame) { return frame == 3 || frame == 6; }
/// World z of an altitude in that frame: the sea is at z = 0.
constexpr double world_z_of(std::uint8_t frame, double alt_m, double home_z_m) {
  return is_above_home(frame) ? alt_m + home_z_m : alt_m;
}

}  // namespace gnbv::mavlink
