// The one border between our frames (world ENU, body FLU) and MAVLink's (NED, FRD). The local
// origin is the scenario's: north is world y, east world x, down counts from z = 0.
#pragma once

#include <string>
#include <variant>

#include "sim/flight/flight.hpp"
#include "sim/mavlink/messages.hpp"
#include "sim/mavlink/state_messages.hpp"

namespace gnbv::mavlink {

/// ENU to NED; its own inverse.
inline Vec3 swap_enu_ned(const Vec3& v) { return {v.y(), v.x(), -v.z()}; }
/// FLU to FRD; its own inverse.
inline Vec3 swap_flu_frd(const Vec3& v) { return {v.x(), -v.y(), -v.z()}; }
/// Heading from east counter-clockwise to heading from north clockwise, in (-pi, pi]; its own
/// inverse.
inline double swap_yaw_enu_ned(double yaw_rad) { return wrap_angle_rad(kPi / 2.0 - yaw_rad); }

/// Attitude of the FRD body in NED: R = Rz(yaw) Ry(pitch) Rx(roll).
struct Euler {
  double roll_rad = 0.0;
  double pitch_rad = 0.0;  // in [-pi/2, pi/2]
  double yaw_rad = 0.0;
};
Euler euler_ned_frd(const Isometry& T_world_body);

Attitude attitude_of(const VehicleState& state, std::uint32_t time_boot_ms);
AttitudeQuaternion attitude_quaternion_of(const VehicleState& state, std::uint32_t time_boot_ms);
LocalPositionNed local_position_of(const VehicleState& state, std::uint32_t time_boot_ms);

/// Where the scenario's origin lies for those clients who ask for latitudes: where PX4's own
/// simulations start, at mean sea level.
constexpr double kOriginLatitude_deg = 47.397742;
constexpr double kOriginLongitude_deg = 8.545594;
GpsGlobalOrigin global_origin();
/// On a sphere of 6371 km, as PX4 projects, in steps of 1e-7 deg (11 mm).
GlobalPositionInt global_position_of(const VehicleState& state, std::uint32_t time_boot_ms);
/// Home on the ground there.
HomePosition home_position_of(const Eigen::Vector2d& home_world_m);
/// What a receiver of satellites would say that makes no errors.
GpsRawInt gps_raw_of(const VehicleState& state, std::uint32_t time_boot_ms);
VfrHud vfr_hud_of(const VehicleState& state, double thrust);

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
