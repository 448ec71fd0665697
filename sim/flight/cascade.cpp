#include "sim/flight/cascade.hpp"

#include <algorithm>
#include <cmath>

#include "sim/flight/rotors.hpp"

namespace gnbv {
namespace {

using Vec2 = Eigen::Vector2d;

Vec3 zero_where_nan(const Vec3& v) { return v.array().isFinite().select(v, 0.0); }

/// base + term where both are given, whichever is given otherwise (ControlMath::addIfNotNan).
Vec3 add_given(const Vec3& base, const Vec3& term) {
  return base.array().isFinite().select(base + zero_where_nan(term), term);
}

/// BlockDerivative with its first-order low-pass.
void update_derivative(PositionControlMemory& memory, const Vec3& v_world_m_s, double cutoff_hz) {
  const double b = 2.0 * kPi * cutoff_hz * kPositionLoop_s;
  const double weight = b / (1.0 + b);
  const Vec3 raw = (v_world_m_s - memory.v_previous_world_m_s) / kPositionLoop_s;
  memory.v_dot_world_m_s2 += weight * (raw - memory.v_dot_world_m_s2);
  memory.v_previous_world_m_s = v_world_m_s;
}

Vec3 velocity_setpoint(const AutopilotParameters& parameters, const VehicleState& state,
                       const Setpoint& setpoint) {
  const Vec3 from_position = parameters.position_p_per_s.cwiseProduct(
      setpoint.p_world_m - Vec3(state.T_world_body.translation()));
  const Vec3 sum = add_given(setpoint.v_world_m_s, from_position);
  const Vec3 priority = zero_where_nan(from_position);
  const Vec3 rest = sum - priority;
  Vec3 limited;
  limited.head<2>() = constrain_xy(priority.head<2>(), rest.head<2>(), parameters.speed_max_m_s);
  limited.z() = std::isfinite(sum.z()) ? std::clamp(sum.z(), -parameters.descent_speed_max_m_s,
                                                    parameters.climb_speed_max_m_s)
                                       : sum.z();
  return limited;
}

/// Thrust command vector for an acceleration, assuming that `hover_thrust` gives one g. It tilts
/// within the limit and is then lengthened until its vertical part is the one needed.
Vec3 thrust_for(const AutopilotParameters& parameters, double gravity_m_s2, double hover_thrust,
                const Vec3& a_world_m_s2) {
  Vec3 body_z_world = Vec3(a_world_m_s2.x(), a_world_m_s2.y(), gravity_m_s2).normalized();
  const double cos_max = std::cos(parameters.tilt_max_rad);
  if (body_z_world.z() < cos_max) {
    const Vec2 side = body_z_world.head<2>().normalized() * std::sin(parameters.tilt_max_rad);
    body_z_world = {side.x(), side.y(), cos_max};
  }
  const double thrust = (a_world_m_s2.z() / gravity_m_s2 + 1.0) * hover_thrust / body_z_world.z();
  return std::max(thrust, parameters.thrust_min) * body_z_world;
}

/// Saturates the thrust vector: vertical first, but with a margin kept for the horizontal part.
Vec3 saturated(const AutopilotParameters& parameters, const Vec3& thrust) {
  const double max_squared = parameters.thrust_max * parameters.thrust_max;
  const double norm_xy = thrust.head<2>().norm();
  const double kept_xy = std::min(norm_xy, parameters.thrust_margin_xy);
  Vec3 limited = thrust;
  limited.z() = std::min(thrust.z(), std::sqrt(max_squared - kept_xy * kept_xy));
  const double max_xy = std::sqrt(std::max(0.0, max_squared - limited.z() * limited.z()));
  if (norm_xy > max_xy) limited.head<2>() *= max_xy / norm_xy;
  return limited;
}

/// Body z along the thrust, body x as near to the heading as that allows (bodyzToAttitude).
Eigen::Quaterniond attitude_for(const Vec3& thrust, double yaw_rad) {
  const Vec3 y_heading(-std::sin(yaw_rad), std::cos(yaw_rad), 0.0);
  Eigen::Matrix3d R;
  R.col(2) = thrust.normalized();
  R.col(0) = y_heading.cross(R.col(2)).normalized();  // tilt stays below 90 deg: never zero
  R.col(1) = R.col(2).cross(R.col(0));
  return Eigen::Quaterniond(R);
}

}  // namespace

bool is_valid(const Setpoint& setpoint) {
  const auto is_given = [](const Vec3& v) { return v.array().isFinite().eval(); };
  const auto p = is_given(setpoint.p_world_m);
  const auto v = is_given(setpoint.v_world_m_s);
  const auto a = is_given(setpoint.a_world_m_s2);
  return (p || v || a).all() && p.x() == p.y() && v.x() == v.y() && a.x() == a.y();
}

Eigen::Vector2d constrain_xy(const Eigen::Vector2d& priority, const Eigen::Vector2d& rest,
                             double max_m_s) {
  const Vec2 sum = priority + rest;
  if (!(sum.norm() > max_m_s)) return sum;  // NaN passes: the axes are not controlled
  if (priority.norm() >= max_m_s) return priority.normalized() * max_m_s;
  // priority + s * direction of length max, s > 0
  const Vec2 direction = rest.normalized();
  const double along = direction.dot(priority);
  const double inside = priority.squaredNorm() - max_m_s * max_m_s;
  return priority + direction * (-along + std::sqrt(along * along - inside));
}

AttitudeSetpoint position_control(const AutopilotParameters& parameters,
                                  const AirframeParameters& airframe, PositionControlMemory& memory,
                                  const VehicleState& state, const Setpoint& given) {
  const double gravity_m_s2 = airframe.gravity_m_s2;
  const double hover_thrust = hover_command(airframe);
  Setpoint setpoint = given;
  if (!is_valid(given)) {
    setpoint = Setpoint{};
    setpoint.v_world_m_s = Vec3::Zero();
    setpoint.yaw_rad = given.yaw_rad;
  }
  update_derivative(memory, state.v_world_m_s, parameters.velocity_derivative_cutoff_hz);

  Vec3 error_m_s = velocity_setpoint(parameters, state, setpoint) - state.v_world_m_s;
  const Vec3 a_setpoint =
      add_given(setpoint.a_world_m_s2,
                parameters.velocity_p_per_s.cwiseProduct(error_m_s) + memory.integral_m_s2 -
                    parameters.velocity_d.cwiseProduct(memory.v_dot_world_m_s2));
  const Vec3 wanted = thrust_for(parameters, gravity_m_s2, hover_thrust, a_setpoint);
  const Vec3 thrust = saturated(parameters, wanted);

  // anti-windup: the vertical integral waits at the limits, the horizontal one tracks what is
  // produced (Rundqwist 1990)
  if ((wanted.z() <= parameters.thrust_min && error_m_s.z() <= 0.0) ||
      (wanted.z() >= parameters.thrust_max && error_m_s.z() >= 0.0)) {
    error_m_s.z() = 0.0;
  }
  const Vec2 a_wanted = a_setpoint.head<2>();
  const Vec2 a_produced = thrust.head<2>() * (gravity_m_s2 / hover_thrust);
  if (a_wanted.squaredNorm() > a_produced.squaredNorm()) {
    error_m_s.head<2>() -= 2.0 / parameters.velocity_p_per_s.x() * (a_wanted - a_produced);
  }
  memory.integral_m_s2 +=
      kPositionLoop_s * parameters.velocity_i_per_s2.cwiseProduct(zero_where_nan(error_m_s));
  memory.integral_m_s2.z() = std::clamp(memory.integral_m_s2.z(), -gravity_m_s2, gravity_m_s2);

  const bool has_yaw = std::isfinite(setpoint.yaw_rad);
  return {attitude_for(thrust, has_yaw ? setpoint.yaw_rad : yaw_of(state.T_world_body)),
          thrust.norm(), std::isfinite(setpoint.yaw_rate_rad_s) ? setpoint.yaw_rate_rad_s : 0.0};
}

Vec3 attitude_control(const AutopilotParameters& parameters, const Eigen::Quaterniond& q_world_body,
                      const AttitudeSetpoint& setpoint) {
  const Eigen::Quaterniond& q = q_world_body;
  // the smallest turn that aligns the thrust axis, and what heading is then left
  const Vec3 z_now = q * Vec3::UnitZ();
  const Vec3 z_wanted = setpoint.q_world_body * Vec3::UnitZ();
  const Eigen::Quaterniond q_reduced = turn_between(z_now, z_wanted) * q;
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

RotorCommands rate_control(const AutopilotParameters& parameters, const Allocation& allocation,
                           RateControlMemory& memory, const Vec3& omega_body_rad_s,
                           const Vec3& omega_setpoint_body_rad_s, double thrust) {
  const Vec3 error_rad_s = omega_setpoint_body_rad_s - omega_body_rad_s;
  const Vec3 alpha_rad_s2 = (omega_body_rad_s - memory.omega_previous_body_rad_s) / kRateStep_s;
  memory.omega_previous_body_rad_s = omega_body_rad_s;
  const Vec3 torque = parameters.rate_p.cwiseProduct(error_rad_s) + memory.integral -
                      parameters.rate_d.cwiseProduct(alpha_rad_s2);
  const MixerOutput mixed = mix(allocation, torque, thrust);

  for (int i = 0; i < 3; ++i) {
    double error = error_rad_s[i];
    if (memory.saturation[i] > 0) error = std::min(error, 0.0);
    if (memory.saturation[i] < 0) error = std::max(error, 0.0);
    // large errors integrate less, against the bounce after a flip
    const double ratio = error / parameters.rate_integral_fade_rad_s;
    const double fade = std::max(0.0, 1.0 - ratio * ratio);
    memory.integral[i] =
        std::clamp(memory.integral[i] + fade * parameters.rate_i[i] * error * kRateStep_s,
                   -parameters.rate_integral_max, parameters.rate_integral_max);
    constexpr double kRounding = 1e-7;  // FLT_EPSILON in PX4
    const double missing = torque[i] - mixed.torque[i];
    memory.saturation[i] = missing > kRounding ? 1 : (missing < -kRounding ? -1 : 0);
  }
  return mixed.commands;
}

}  // namespace gnbv
