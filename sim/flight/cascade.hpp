// PX4's multicopter cascade in ENU and FLU. The position and velocity loops (PositionControl.cpp,
// ControlMath.cpp) make an attitude and a thrust of a setpoint, the attitude loop
// (AttitudeControl.cpp) a body rate, the rate loop (rate_control.cpp) and the mixer rotor commands.
#pragma once

#include "sim/flight/flight.hpp"
#include "sim/flight/rotors.hpp"

namespace gnbv {

/// Position and velocity loops at 50 Hz, attitude at every 4 ms tick, rate and mixer at 1 kHz.
constexpr int kTicksPerPositionLoop = 5;
constexpr double kPositionLoop_s = kTicksPerPositionLoop * kTick_s;

/// What the position and velocity loops remember between calls.
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

/// One pass of both loops, kPositionLoop_s after the last. An invalid setpoint stops the vehicle
/// (zero velocity). Hover thrust is the true hover command, to which PX4's estimator converges.
AttitudeSetpoint position_control(const AutopilotParameters& parameters,
                                  const AirframeParameters& airframe, PositionControlMemory& memory,
                                  const VehicleState& state, const Setpoint& setpoint);

/// Rate setpoint, body axes. Turns the thrust direction first and weighs heading less; the newest
/// PX4's attitude reference model is left out.
Vec3 attitude_control(const AutopilotParameters& parameters, const Eigen::Quaterniond& q_world_body,
                      const AttitudeSetpoint& setpoint);

struct RateControlMemory {
  Vec3 integral = Vec3::Zero();
  Vec3 omega_previous_body_rad_s = Vec3::Zero();
  Eigen::Vector3i saturation = Eigen::Vector3i::Zero();  // of the mixer, per axis: -1, 0 or +1
};

/// Rate loop and mixer, kRateStep_s after the last. PX4's low-passes of gyro and D-term (30 Hz) are
/// left out: the rate here is the truth and has no noise.
RotorCommands rate_control(const AutopilotParameters& parameters, const Allocation& allocation,
                           RateControlMemory& memory, const Vec3& omega_body_rad_s,
                           const Vec3& omega_setpoint_body_rad_s, double thrust);

}  // namespace gnbv
