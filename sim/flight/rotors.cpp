#include "sim/flight/rotors.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

/// Rows: roll, pitch, yaw, thrust; a column for each rotor.
using Effect = Eigen::Matrix<double, 4, Eigen::Dynamic, 0, 4, kMostRotors>;

constexpr std::array<std::string_view, 4> kAxes = {"roll", "pitch", "yaw", "thrust"};

/// What each rotor's thrust does about the centre of mass. Each row is divided by its greatest
/// entry; the normalisation of the pseudo-inverse takes that out again.
Effect effect_of(const AirframeParameters& airframe) {
  Effect effect(4, static_cast<Eigen::Index>(airframe.rotors.size()));
  for (Eigen::Index i = 0; i < effect.cols(); ++i) {
    const RotorMount& rotor = airframe.rotors[static_cast<std::size_t>(i)];
    // the body is turned against the rotor
    effect.col(i) << rotor.p_body_m.y(), -rotor.p_body_m.x(),
        -rotor.spin * airframe.moment_per_thrust_m, 1.0;
  }
  for (Eigen::Index axis = 0; axis < 4; ++axis) {
    const double most = effect.row(axis).cwiseAbs().maxCoeff();
    if (most > 0.0) effect.row(axis) /= most;
  }
  return effect;
}

bool is_quad_x(const AirframeParameters& airframe) {
  if (airframe.rotors.size() != 4) return false;
  constexpr double kAngleMax_rad = deg_to_rad(20.0);
  constexpr double kUnevenMax = 0.1;
  std::array<double, 4> spins{};  // by quadrant, counter-clockwise
  double arms_m = 0.0;
  Eigen::Vector2d sum_m = Eigen::Vector2d::Zero();
  for (const RotorMount& rotor : airframe.rotors) {
    const Eigen::Vector2d p_m = rotor.p_body_m.head<2>();
    const double angle_rad = std::atan2(std::abs(p_m.y()), std::abs(p_m.x()));
    if (std::abs(angle_rad - 0.25 * kPi) > kAngleMax_rad) return false;
    const std::size_t quadrant = p_m.y() > 0.0 ? (p_m.x() > 0.0 ? 0 : 1) : (p_m.x() < 0.0 ? 2 : 3);
    spins[quadrant] = rotor.spin;
    arms_m += 0.25 * p_m.norm();
    sum_m += p_m;
  }
  const auto is_even = [&](const RotorMount& rotor) {
    return std::abs(rotor.p_body_m.head<2>().norm() - arms_m) <= kUnevenMax * arms_m;
  };
  return spins[0] != 0.0 && spins[0] == spins[2] && spins[1] == -spins[0] && spins[3] == spins[1] &&
         sum_m.norm() <= kUnevenMax * arms_m && std::ranges::all_of(airframe.rotors, is_even);
}

Allocation quad_x(const AirframeParameters& airframe) {
  constexpr double kHalfSqrt2 = 0.5 * std::numbers::sqrt2;
  Allocation quad{.rotors = 4};
  for (std::size_t i = 0; i < 4; ++i) {
    const RotorMount& rotor = airframe.rotors[i];
    quad.torque[0].command[i] = std::copysign(kHalfSqrt2, rotor.p_body_m.y());
    quad.torque[1].command[i] = std::copysign(kHalfSqrt2, -rotor.p_body_m.x());
    quad.torque[2].command[i] = -rotor.spin;
    quad.thrust[i] = 1.0;
  }
  for (TorqueAllocation& axis : quad.torque) {
    axis.share = axis.command;
    axis.share_divisor = 0.0;
    for (std::size_t i = 0; i < 4; ++i) axis.share_divisor += axis.command[i] * axis.command[i];
  }
  return quad;
}

/// The pseudo-inverse: rows are rotors, columns axes.
using Mix = Eigen::Matrix<double, Eigen::Dynamic, 4, 0, kMostRotors, 4>;

/// PX4's scales. Roll and pitch, one for both: the rotors that take part move by half the root of 2
/// (root mean square). Yaw: the rotor that moves most moves by 1. Thrust: its mean.
Eigen::Vector4d scales_of(const Mix& mix) {
  const auto tilt_scale = [&](Eigen::Index axis) {
    const auto taking_part = static_cast<double>((mix.col(axis).array().abs() > 1e-3).count());
    return std::sqrt(mix.col(axis).squaredNorm() / (0.5 * taking_part));
  };
  const double tilt = std::max(tilt_scale(0), tilt_scale(1));
  return {tilt, tilt, mix.col(2).maxCoeff(), mix.col(3).mean()};
}

constexpr double kYawHeadroom = 0.15;  // MINIMUM_YAW_MARGIN: yaw may ask for this much above full

/// The commands of the rotors there are; the rest stay 0.
class Desaturation {
 public:
  explicit Desaturation(std::size_t rotors) : rotors_(rotors) {}

  void add(double gain, const RotorValues& direction) {
    for (std::size_t i = 0; i < rotors_; ++i) commands[i] += gain * direction[i];
  }

  void along(const RotorValues& direction, double max) {
    if (!is_saturated(max)) return;  // both gains are 0
    add(gain(direction, max), direction);
    // what cannot be freed is shared: half of what is left is moved to the other end
    add(0.5 * gain(direction, max), direction);
  }

  void thrust_down(const RotorValues& thrust) {
    if (!is_saturated(1.0)) return;
    RotorValues less{};
    for (std::size_t i = 0; i < rotors_; ++i) less[i] = -thrust[i];
    if (gain(less, 1.0) >= 0.0) along(less, 1.0);
  }

  double share_of(const TorqueAllocation& axis) const {
    double dot = 0.0;
    for (std::size_t i = 0; i < rotors_; ++i) dot += commands[i] * axis.share[i];
    return dot / axis.share_divisor;
  }

  RotorCommands commands{};

 private:
  bool is_saturated(double max) const {
    bool is_outside = false;
    for (std::size_t i = 0; i < rotors_; ++i) {
      is_outside |= commands[i] < 0.0 || commands[i] > max;
    }
    return is_outside;
  }

  /// The step along `direction` that frees the rotors of saturation as far as it can: the sum of
  /// the farthest steps asked for either way.
  double gain(const RotorValues& direction, double max) const {
    double least = 0.0;
    double most = 0.0;
    for (std::size_t i = 0; i < rotors_; ++i) {
      if (std::abs(direction[i]) < 1e-3) continue;  // it hardly moves this rotor
      const double excess = commands[i] < 0.0 ? commands[i] : std::max(commands[i] - max, 0.0);
      const double step = -excess / direction[i];
      least = std::min(least, step);
      most = std::max(most, step);
    }
    return least + most;
  }

  std::size_t rotors_;
};

}  // namespace

RotorLag rotor_lag(const AirframeParameters& airframe, double step_s) {
  return {std::exp(-step_s / airframe.time_constant_up_s),
          std::exp(-step_s / airframe.time_constant_down_s)};
}

double rotor_speed_after(const RotorLag& lag, double speed_rad_s, double reference_rad_s) {
  const double left = reference_rad_s > speed_rad_s ? lag.up : lag.down;
  return reference_rad_s + (speed_rad_s - reference_rad_s) * left;
}

RotorSpeeds reference_speeds(const AirframeParameters& airframe, const RotorCommands& commands) {
  RotorSpeeds speeds_rad_s{};
  for (std::size_t i = 0; i < airframe.rotors.size(); ++i) {
    speeds_rad_s[i] = airframe.idle_speed_rad_s + airframe.command_gain_rad_s * commands[i];
  }
  return speeds_rad_s;
}

double hover_speed_rad_s(const AirframeParameters& airframe) {
  const double weight_n = airframe.mass_kg * airframe.gravity_m_s2;
  return std::sqrt(
      weight_n / (static_cast<double>(airframe.rotors.size()) * airframe.thrust_coefficient_n_s2));
}

double hover_command(const AirframeParameters& airframe) {
  const double command = needed_hover_command(airframe);
  GNBV_CHECK(command > 0.0 && command < 1.0, "hover command {} is not in (0, 1)", command);
  return command;
}

double yaw_authority_rad_s2(const AirframeParameters& airframe) {
  const double thrust_per_command_n = 2.0 * airframe.thrust_coefficient_n_s2 *
                                      hover_speed_rad_s(airframe) * airframe.command_gain_rad_s;
  const Allocation allocation = allocation_of(airframe);
  double turning = 0.0;
  for (std::size_t i = 0; i < allocation.rotors; ++i) {
    turning -= airframe.rotors[i].spin * allocation.torque[2].command[i];
  }
  return turning * airframe.moment_per_thrust_m * thrust_per_command_n / airframe.inertia_kg_m2.z();
}

double thrust_share(const AirframeParameters& airframe, const Vec3& v_rotor_body_m_s) {
  const auto share_at = [&](double speed_m_s) {
    return std::clamp(1.0 - speed_m_s / airframe.thrust_loss_limit_m_s, 0.0, 1.0);
  };
  switch (airframe.thrust_loss) {
    case ThrustLoss::none:
      return 1.0;
    case ThrustLoss::axial_speed:
      return share_at(std::abs(v_rotor_body_m_s.z()));
    case ThrustLoss::whole_speed:
      return share_at(v_rotor_body_m_s.norm());
  }
  throw BrokenInvariant("thrust loss outside its enumeration");
}

Wrench rotor_wrench(const AirframeParameters& airframe, const RotorSpeeds& speeds_rad_s,
                    const Vec3& v_body_m_s, const Vec3& omega_body_rad_s) {
  Wrench sum;
  for (std::size_t i = 0; i < airframe.rotors.size(); ++i) {
    const RotorMount& rotor = airframe.rotors[i];
    const double speed_rad_s = speeds_rad_s[i];
    const Vec3 v_rotor_m_s = v_body_m_s + omega_body_rad_s.cross(rotor.p_body_m);
    const Vec3 v_disk_m_s(v_rotor_m_s.x(), v_rotor_m_s.y(), 0.0);
    const double thrust_at_rest_n = airframe.thrust_coefficient_n_s2 * speed_rad_s * speed_rad_s;
    const double thrust_n = thrust_at_rest_n * thrust_share(airframe, v_rotor_m_s);

    const Vec3 force_n =
        thrust_n * Vec3::UnitZ() - speed_rad_s * airframe.drag_coefficient_n_s2_per_m * v_disk_m_s;
    // the plugin takes the reaction torque from the thrust at rest
    Vec3 torque_n_m = rotor.p_body_m.cross(force_n);
    torque_n_m.z() -= rotor.spin * airframe.moment_per_thrust_m * thrust_at_rest_n;
    const double rolling_sign = airframe.rolling_follows_spin ? rotor.spin : 1.0;
    torque_n_m -= rolling_sign * speed_rad_s * airframe.rolling_coefficient_n_s2 * v_disk_m_s;

    sum.force_body_n += force_n;
    sum.torque_body_n_m += torque_n_m;
    sum.thrust_n += thrust_n;
  }
  return sum;
}

double power_w(const PowerParameters& power, double thrust_n, const Vec3& v_world_m_s) {
  const double half_climb_m_s = 0.5 * v_world_m_s.z();
  const double v_horizontal_m_s = v_world_m_s.head<2>().norm();
  const double induced_w = power.k1 * thrust_n *
                           (half_climb_m_s + std::sqrt(half_climb_m_s * half_climb_m_s +
                                                       thrust_n / (power.k2 * power.k2)));
  const double profile_w = power.c2 * thrust_n * std::sqrt(thrust_n);
  const double parasitic_w = power.c4 * v_horizontal_m_s * v_horizontal_m_s * v_horizontal_m_s;
  return induced_w + profile_w + parasitic_w;
}

double hover_power_w(const VehicleConfig& vehicle) {
  const double weight_n = vehicle.airframe.mass_kg * vehicle.airframe.gravity_m_s2;
  return power_w(vehicle.power, weight_n, Vec3::Zero());
}

std::string allocation_fault(const AirframeParameters& airframe) {
  const Effect effect = effect_of(airframe);
  if (airframe.moment_per_thrust_m == 0.0) {
    return "moment_per_thrust_m is 0: nothing turns the vehicle about its vertical";
  }
  // what these rotors can least give, by inverse iteration; Eigen's solvers of eigenvalues would
  // take the compiler 8 s
  const Eigen::Matrix4d gram = effect * effect.transpose();
  const Eigen::Matrix4d I = Eigen::Matrix4d::Identity();
  const Eigen::Matrix4d inverse = (gram + 1e-12 * I).ldlt().solve(I);
  Eigen::Index strongest = 0;
  inverse.diagonal().maxCoeff(&strongest);
  Eigen::Vector4d inseparable = inverse.col(strongest).normalized();
  for (int i = 0; i < 3; ++i) inseparable = (inverse * inseparable).normalized();
  constexpr double kSingular = 1e-3;  // of rows that reach up to 1
  if (inseparable.dot(gram * inseparable) < kSingular * kSingular) {
    std::string axes;
    for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
      if (std::abs(inseparable[static_cast<Eigen::Index>(axis)]) < 0.1) continue;
      axes += (axes.empty() ? "" : " apart from ") + std::string(kAxes[axis]);
    }
    return fmt::format(
        "these rotors cannot give {}: neither their places nor their spins tell the axes apart",
        axes);
  }
  const RotorValues thrust = allocation_of(airframe).thrust;
  for (std::size_t i = 0; i < airframe.rotors.size(); ++i) {
    if (thrust[i] > 0.1) continue;
    return fmt::format(
        "level flight would ask {:.2f} of the mean thrust of rotor {}: the centre "
        "of mass, the origin, is not between the rotors",
        thrust[i], i);
  }
  return "";
}

Allocation allocation_of(const AirframeParameters& airframe) {
  if (is_quad_x(airframe)) return quad_x(airframe);
  const Effect effect = effect_of(airframe);
  const Eigen::Matrix4d gram = effect * effect.transpose();
  const Mix mix = effect.transpose() * gram.ldlt().solve(Eigen::Matrix4d::Identity());
  GNBV_CHECK(mix.allFinite(), "rotors that cannot steer");
  const Eigen::Vector4d scales = scales_of(mix);
  Allocation allocation{.rotors = airframe.rotors.size()};
  for (std::size_t i = 0; i < allocation.rotors; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto column = static_cast<Eigen::Index>(axis);
      allocation.torque[axis].command[i] = mix(row, column) / scales[column];
      allocation.torque[axis].share[i] = effect(column, row) * scales[column];
    }
    allocation.thrust[i] = mix(row, 3) / scales[3];
  }
  return allocation;
}

MixerOutput mix(const Allocation& allocation, const Vec3& torque, double thrust) {
  const auto& [roll, pitch, yaw] = allocation.torque;
  Desaturation rotors(allocation.rotors);
  rotors.add(thrust, allocation.thrust);
  rotors.add(torque.x(), roll.command);
  rotors.add(torque.y(), pitch.command);
  rotors.thrust_down(allocation.thrust);
  rotors.along(roll.command, 1.0);
  rotors.along(pitch.command, 1.0);
  rotors.add(torque.z(), yaw.command);
  rotors.along(yaw.command, 1.0 + kYawHeadroom);
  rotors.thrust_down(allocation.thrust);
  for (double& command : rotors.commands) command = std::clamp(command, 0.0, 1.0);
  return {rotors.commands, {rotors.share_of(roll), rotors.share_of(pitch), rotors.share_of(yaw)}};
}

}  // namespace gnbv
