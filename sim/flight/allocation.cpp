#include "sim/flight/allocation.hpp"

#include <Eigen/Cholesky>
#include <Eigen/SVD>
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
/// Of rows that reach up to 1: below this the axes are not told apart.
constexpr double kSingular = 1e-3;

/// What each rotor's thrust does about the centre of mass; each row divided by its greatest entry,
/// which the normalisation of the columns takes out again.
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

/// PX4's scales: roll and pitch, one for both, so that the rotors that take part move by half the
/// root of 2 on a root mean square; yaw, so that the most driven moves by 1; thrust, by its mean.
Eigen::Vector4d scales_of(const Eigen::Matrix<double, Eigen::Dynamic, 4, 0, kMostRotors, 4>& mix) {
  const auto tilt_scale = [&](Eigen::Index axis) {
    const auto taking_part = static_cast<double>((mix.col(axis).array().abs() > 1e-3).count());
    return std::sqrt(mix.col(axis).squaredNorm() / (0.5 * taking_part));
  };
  const double tilt = std::max(tilt_scale(0), tilt_scale(1));
  return {tilt, tilt, mix.col(2).maxCoeff(), mix.col(3).mean()};
}

}  // namespace

std::string allocation_fault(const AirframeParameters& airframe) {
  const Effect effect = effect_of(airframe);
  if (airframe.moment_per_thrust_m == 0.0) {
    return "moment_per_thrust_m is 0: nothing turns the vehicle about its vertical";
  }
  const Eigen::JacobiSVD<Effect> svd(effect, Eigen::ComputeFullU);
  if (svd.singularValues()[3] < kSingular) {
    const Eigen::Vector4d inseparable = svd.matrixU().col(3);
    std::string axes;
    for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
      if (std::abs(inseparable[static_cast<Eigen::Index>(axis)]) < 0.1) continue;
      axes += (axes.empty() ? "" : " apart from ") + std::string(kAxes[axis]);
    }
    return fmt::format("these rotors cannot give {}: neither their places nor their spins tell",
                       axes) +
           " the axes apart";
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
  const Eigen::Matrix<double, Eigen::Dynamic, 4, 0, kMostRotors, 4> mix =
      effect.transpose() * gram.ldlt().solve(Eigen::Matrix4d::Identity());
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

}  // namespace gnbv
