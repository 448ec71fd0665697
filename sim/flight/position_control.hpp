// PX4's multicopter position and velocity loops (PositionControl.cpp, ControlMath.cpp) in ENU and
// FLU: a setpoint becomes a thrust vector and a heading.
#pragma once

#include "sim/flight/flight.hpp"

namespace gnbv {

/// What the loops remember between calls.
struct PositionControlMemory {
  Vec3 integral_m_s2 = Vec3::Zero();
  Vec3 v_previous_world_m_s = Vec3::Zero();
  Vec3 v_dot_world_m_s2 = Vec3::Zero();  // derivative of the velocity, low-passed
};

struct AttitudeSetpoint {
  Eigen::Quaterniond q_world_body = Eigen::Quaterniond::Identity();
  double thrust = 0.0;          // command along body z, in [0, 1]
  double yaw_rate_rad_s = 0.0;  // feed-forward about world z
};

/// PositionControl::_inputValid: every axis has a position, velocity or acceleration, and x and y
/// are given in pairs.
bool is_valid(const Setpoint& setpoint);

/// Sum of two velocities no longer than `max_m_s`; shortens `rest` first
/// (ControlMath::constrainXY).
Eigen::Vector2d constrain_xy(const Eigen::Vector2d& priority, const Eigen::Vector2d& rest,
                             double max_m_s);

/// One pass of both loops, `dt_s` after the last. An invalid setpoint stops the vehicle (zero
/// velocity). `hover_thrust` is the command at which thrust equals weight.
AttitudeSetpoint position_control(const AutopilotParameters& parameters, double gravity_m_s2,
                                  double hover_thrust, PositionControlMemory& memory,
                                  const VehicleState& state, const Setpoint& setpoint, double dt_s);

}  // namespace gnbv
