#include "sim/flight/attitude_control.hpp"

#include <algorithm>
#include <cmath>

namespace gnbv {

Vec3 attitude_control(const AutopilotParameters& parameters, const Eigen::Quaterniond& q_world_body,
                      const AttitudeSetpoint& setpoint) {
  const Eigen::Quaterniond& q = q_world_body;
  // the smallest turn that aligns the thrust axis, and what heading is then left
  const Vec3 z_now = q * Vec3::UnitZ();
  const Vec3 z_wanted = setpoint.q_world_body * Vec3::UnitZ();
  const Eigen::Quaterniond q_reduced = Eigen::Quaterniond::FromTwoVectors(z_now, z_wanted) * q;
  Eigen::Quaterniond q_heading = q_reduced.conjugate() * setpoint.q_world_body;
  if (q_heading.w() < 0.0) q_heading.coeffs() *= -1.0;
  const double half_heading_rad = std::atan2(q_heading.z(), q_heading.w());
  const double half_mixed_rad = parameters.yaw_weight * half_heading_rad;
  const Eigen::Quaterniond q_mixed =
      q_reduced * Eigen::Quaterniond(std::cos(half_mixed_rad), 0.0, 0.0, std::sin(half_mixed_rad));

  const Eigen::Quaterniond q_error = q.conjugate() * q_mixed;
  const Vec3 error_rad = (q_error.w() < 0.0 ? -2.0 : 2.0) * q_error.vec();
  Vec3 gain_per_s = parameters.attitude_p_per_s;
  gain_per_s.z() /= parameters.yaw_weight;  // so that the weight does not slow yaw alone
  const Vec3 rate_rad_s = gain_per_s.cwiseProduct(error_rad) +
                          setpoint.yaw_rate_rad_s * (q.conjugate() * Vec3::UnitZ());
  return rate_rad_s.cwiseMax(-parameters.rate_max_rad_s).cwiseMin(parameters.rate_max_rad_s);
}

Vec3 rate_control(const AutopilotParameters& parameters, RateControlMemory& memory,
                  const Vec3& omega_body_rad_s, const Vec3& omega_setpoint_body_rad_s,
                  double dt_s) {
  const Vec3 error_rad_s = omega_setpoint_body_rad_s - omega_body_rad_s;
  const Vec3 alpha_rad_s2 = (omega_body_rad_s - memory.omega_previous_body_rad_s) / dt_s;
  memory.omega_previous_body_rad_s = omega_body_rad_s;
  const Vec3 torque = parameters.rate_p.cwiseProduct(error_rad_s) + memory.integral -
                      parameters.rate_d.cwiseProduct(alpha_rad_s2);

  for (int i = 0; i < 3; ++i) {
    double error = error_rad_s[i];
    if (memory.saturation[i] > 0) error = std::min(error, 0.0);
    if (memory.saturation[i] < 0) error = std::max(error, 0.0);
    // large errors integrate less, against the bounce after a flip
    const double ratio = error / parameters.rate_integral_fade_rad_s;
    const double fade = std::max(0.0, 1.0 - ratio * ratio);
    memory.integral[i] = std::clamp(memory.integral[i] + fade * parameters.rate_i[i] * error * dt_s,
                                    -parameters.rate_integral_max, parameters.rate_integral_max);
  }
  return torque;
}

}  // namespace gnbv
