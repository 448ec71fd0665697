// Between torque and thrust and the rotors, as pure functions: the rotor laws of
// PX4-SITL_gazebo-classic (src/gazebo_motor_model.cpp, include/common.h), the power they draw, and
// PX4's control allocation for any layout of four to eight.
#pragma once

#include <string>

#include "sim/flight/vehicle_config.hpp"

namespace gnbv {

/// What is left of a rotor's distance to its reference after a step.
struct RotorLag {
  double up;
  double down;
};
RotorLag rotor_lag(const AirframeParameters& airframe, double step_s);
/// Speed after a step of a constant reference: first order, exact, slower down than up.
double rotor_speed_after(const RotorLag& lag, double speed_rad_s, double reference_rad_s);

/// References of armed rotors.
RotorSpeeds reference_speeds(const AirframeParameters& airframe, const RotorCommands& commands);

/// The command for which an armed rotor's reference is that speed.
inline double command_at_speed(const AirframeParameters& airframe, double speed_rad_s) {
  return (speed_rad_s - airframe.idle_speed_rad_s) / airframe.command_gain_rad_s;
}
double hover_speed_rad_s(const AirframeParameters& airframe);
/// The command at which thrust equals weight; not in (0, 1) where the vehicle cannot hover.
inline double needed_hover_command(const AirframeParameters& airframe) {
  return command_at_speed(airframe, hover_speed_rad_s(airframe));
}
/// The same of a vehicle that can.
double hover_command(const AirframeParameters& airframe);

/// Angular acceleration about body z for a unit of yaw command, at hover.
double yaw_authority_rad_s2(const AirframeParameters& airframe);

/// What is left of a rotor's thrust at rest when it moves through the air, in [0, 1].
double thrust_share(const AirframeParameters& airframe, const Vec3& v_rotor_body_m_s);

struct Wrench {
  Vec3 force_body_n = Vec3::Zero();
  Vec3 torque_body_n_m = Vec3::Zero();
  double thrust_n = 0.0;  // along body z
};
/// Sum over the rotors, about the centre of mass, without gravity. `v_body_m_s`: through the air.
Wrench rotor_wrench(const AirframeParameters& airframe, const RotorSpeeds& speeds_rad_s,
                    const Vec3& v_body_m_s, const Vec3& omega_body_rad_s);

constexpr double kJoulesPerWattHour = 3600.0;

/// Electrical power by PowerParameters' law at that velocity through the air.
double power_w(const PowerParameters& power, double thrust_n, const Vec3& v_world_m_s);
/// Power in a still hover: the thrust is the weight.
double hover_power_w(const VehicleConfig& vehicle);

/// Of a unit of normalised torque about one body axis.
struct TorqueAllocation {
  RotorValues command{};  // what it asks of each rotor
  RotorValues share{};    // what of it each rotor's command gives, times `share_divisor`
  double share_divisor = 1.0;
};

struct Allocation {
  std::size_t rotors = 0;
  std::array<TorqueAllocation, 3> torque{};  // about body x, y, z: roll, pitch, yaw
  RotorValues thrust{};                      // without torque; its mean is 1
};

/// The pseudo-inverse of the allocation matrix, normalised as PX4's
/// (ControlAllocationPseudoInverse.cpp). Quads in an X, their four arms about equal and within 20
/// degrees of the diagonals, are allocated by the quadrant of each rotor alone, as PX4's mixers do.
/// Throws BrokenInvariant where allocation_fault() names a fault.
Allocation allocation_of(const AirframeParameters& airframe);

/// One sentence: why these rotors cannot steer a vehicle. Empty if they can.
std::string allocation_fault(const AirframeParameters& airframe);

struct MixerOutput {
  RotorCommands commands{};
  Vec3 torque = Vec3::Zero();  // the normalised torque that these commands give
};

/// PX4's sequential desaturation with airmode off (ControlAllocationSequentialDesaturation.cpp):
/// yaw gives way first, then thrust, then roll and pitch. `torque`: normalised, body axes. `thrust`
/// in [0, 1].
MixerOutput mix(const Allocation& allocation, const Vec3& torque, double thrust);

}  // namespace gnbv
