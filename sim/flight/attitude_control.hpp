// PX4's attitude and rate loops (AttitudeControl.cpp, rate_control.cpp), in FLU.
#pragma once

#include <array>

#include "sim/flight/position_control.hpp"

namespace gnbv {

/// Rate setpoint, body axes. Turns the thrust direction first and weighs heading less; the newest
/// PX4's attitude reference model is left out.
Vec3 attitude_control(const AutopilotParameters& parameters, const Eigen::Quaterniond& q_world_body,
                      const AttitudeSetpoint& setpoint);

struct RateControlMemory {
  Vec3 integral = Vec3::Zero();
  Vec3 omega_previous_body_rad_s = Vec3::Zero();
  Eigen::Vector3i saturation = Eigen::Vector3i::Zero();  // of the mixer, per axis: -1, 0 or +1
};

/// Normalised torque command about the body axes. Gyro and D-term low-passes (30 Hz) are left out:
/// the rate measured here is the truth and has no noise to remove.
Vec3 rate_control(const AutopilotParameters& parameters, RateControlMemory& memory,
                  const Vec3& omega_body_rad_s, const Vec3& omega_setpoint_body_rad_s, double dt_s);

}  // namespace gnbv
