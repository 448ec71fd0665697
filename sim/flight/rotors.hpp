// Rotor laws of PX4-SITL_gazebo-classic src/gazebo_motor_model.cpp and include/common.h, as pure
// functions, and the power a flight draws.
#pragma once

#include "sim/flight/vehicle_config.hpp"

namespace gnbv {

/// Speed after `dt_s` of a constant reference: first order, exact, slower down than up.
double rotor_speed_after(const AirframeParameters& airframe, double speed_rad_s,
                         double reference_rad_s, double dt_s);

/// References of armed rotors.
RotorSpeeds reference_speeds(const AirframeParameters& airframe, const RotorCommands& commands);

/// The command for which an armed rotor's reference is that speed.
double command_at_speed(const AirframeParameters& airframe, double speed_rad_s);
double hover_speed_rad_s(const AirframeParameters& airframe);
/// The command at which thrust equals weight; not in (0, 1) where the vehicle cannot hover.
double hover_command(const AirframeParameters& airframe);

/// Angular acceleration about body z for a unit of yaw command, at hover.
double yaw_authority_rad_s2(const AirframeParameters& airframe);

/// What is left of a rotor's thrust at rest when it moves through the air, in [0, 1].
double thrust_share(const AirframeParameters& airframe, const Vec3& v_rotor_body_m_s);

/// Sum over the rotors, about the centre of mass, without gravity.
struct Wrench {
  Vec3 force_body_n = Vec3::Zero();
  Vec3 torque_body_n_m = Vec3::Zero();
  double thrust_n = 0.0;  // along body z
};
/// `v_body_m_s`: of the body through the air.
Wrench rotor_wrench(const AirframeParameters& airframe, const RotorSpeeds& speeds_rad_s,
                    const Vec3& v_body_m_s, const Vec3& omega_body_rad_s);

constexpr double kJoulesPerWattHour = 3600.0;

/// Electrical power by PowerParameters' law at that velocity through the air.
double power_w(const PowerParameters& power, double thrust_n, const Vec3& v_world_m_s);
/// Power in a still hover: the thrust is the weight.
double hover_power_w(const VehicleConfig& vehicle);

}  // namespace gnbv
