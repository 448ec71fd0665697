// The one border between our frames (world ENU, body FLU) and MAVLink's (NED, FRD). The local
// origin is the scenario's: north is world y, east world x, down counts from z = 0.
#pragma once

#include <string>
#include <variant>

#include "sim/flight/flight.hpp"
#include "sim/mavlink/messages.hpp"

namespace gnbv::mavlink {

/// ENU to NED; its own inverse.
inline Vec3 swap_enu_ned(const Vec3& v) { return {v.y(), v.x(), -v.z()}; }
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
                                            double yaw_world_rad);

}  // namespace gnbv::mavlink
