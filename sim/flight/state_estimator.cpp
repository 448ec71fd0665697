#include "sim/flight/state_estimator.hpp"

#include <algorithm>
#include <cmath>

#include "sim/core/error.hpp"
#include "sim/core/rng.hpp"

namespace gnbv {
namespace {

constexpr double kMocapPosition_m = 0.001;
constexpr double kMocapAngle_rad = deg_to_rad(0.1);
constexpr double kGnssFrequency_rad_s = 0.05;
constexpr double kVioCorrelation_m = 100.0;

Eigen::Vector4d gnss_sigma() { return {0.5, 0.5, 0.5, deg_to_rad(2.0)}; }

Eigen::Vector4d vio_sigma_per_m() {
  const double each_axis = 0.01 / std::sqrt(3.0);
  return {each_axis, each_axis, each_axis, deg_to_rad(0.01)};
}

}  // namespace

StateEstimator::StateEstimator(const EstimateConfig& config, std::uint64_t seed,
                               const VehicleState& start)
    : config_(config), seed_(seed), p_last_world_m_(start.T_world_body.translation()) {
  if (config_.model == EstimateModel::gnss) {
    // position and rate of the stationary process are independent, sigma_rate = frequency * sigma
    error_ = gnss_sigma().cwiseProduct(normals(4));
    error_rate_per_s_ = (gnss_sigma() * kGnssFrequency_rad_s).cwiseProduct(normals(8));
  }
  if (config_.model == EstimateModel::vio) drift_per_m_ = vio_sigma_per_m().cwiseProduct(normals());
}

StateEstimator::Vec4 StateEstimator::normals(std::uint64_t first) const {
  Vec4 numbers;
  for (int i = 0; i < 4; ++i) {
    const std::uint64_t index = first + static_cast<std::uint64_t>(i);
    numbers[i] = standard_normal({seed_, Stream::pose_noise, tick_, index});
  }
  return numbers;
}

bool StateEstimator::is_in_outage() const {
  const double time_s = static_cast<double>(tick_) * kTick_s;
  return std::ranges::any_of(config_.outages, [&](const GnssOutage& outage) {
    return time_s > outage.start_s && time_s <= outage.start_s + outage.duration_s;
  });
}

void StateEstimator::wander() {
  // e'' + 2 w e' + w^2 e = noise of spectral density 4 w^3 sigma^2
  const double w = kGnssFrequency_rad_s;
  const Vec4 noise = normals();
  const Vec4 kick = std::sqrt(4.0 * w * w * w * kTick_s) * gnss_sigma().cwiseProduct(noise);
  error_rate_per_s_ += kick - kTick_s * (2.0 * w * error_rate_per_s_ + w * w * error_);
  if (is_in_outage()) {
    error_rate_per_s_.head<3>().setZero();
    walk_m_ += config_.outage_drift_m_per_sqrt_s * std::sqrt(kTick_s) * noise.head<3>();
  } else {
    walk_m_ *= std::exp(-kTick_s / kOutageFade_s);
  }
  error_ += kTick_s * error_rate_per_s_;
}

void StateEstimator::drift(const VehicleState& truth) {
  const Vec3 p_world_m = truth.T_world_body.translation();
  const double path_m = (p_world_m - p_last_world_m_).norm();
  const double kept = std::exp(-path_m / kVioCorrelation_m);
  error_ += path_m * drift_per_m_;
  drift_per_m_ = kept * drift_per_m_ +
                 std::sqrt(1.0 - kept * kept) * vio_sigma_per_m().cwiseProduct(normals());
  error_rate_per_s_ = truth.v_world_m_s.norm() * drift_per_m_;
  p_last_world_m_ = p_world_m;
}

VehicleState StateEstimator::with_error(const VehicleState& truth) const {
  VehicleState estimate = truth;
  estimate.T_world_body.linear() =
      Eigen::AngleAxisd(error_[3], Vec3::UnitZ()) * truth.T_world_body.linear();
  estimate.T_world_body.translation() += error_.head<3>();
  estimate.v_world_m_s += error_rate_per_s_.head<3>();
  if (config_.outages.empty()) return estimate;
  estimate.T_world_body.translation() += walk_m_;
  if (!is_in_outage()) estimate.v_world_m_s -= walk_m_ / kOutageFade_s;  // it fades
  return estimate;
}

VehicleState StateEstimator::with_jitter(const VehicleState& truth) const {
  const Vec4 first = normals();
  const Vec4 more = normals(4);
  VehicleState estimate = truth;
  const Vec3 turn_rad = kMocapAngle_rad * Vec3(first[3], more[0], more[1]);
  const Eigen::Matrix3d R = Eigen::AngleAxisd(turn_rad.norm(), turn_rad.normalized()).matrix();
  estimate.T_world_body.linear() = R * truth.T_world_body.linear();
  estimate.T_world_body.translation() += kMocapPosition_m * first.head<3>();
  return estimate;
}

VehicleState StateEstimator::step(const VehicleState& truth) {
  ++tick_;  // the constructor has used the numbers of tick 0
  switch (config_.model) {
    case EstimateModel::none:
      return truth;
    case EstimateModel::mocap:
      return with_jitter(truth);
    case EstimateModel::gnss:
      wander();
      return with_error(truth);
    case EstimateModel::vio:
      drift(truth);
      return with_error(truth);
  }
  throw BrokenInvariant("estimate model outside its enumeration");
}

}  // namespace gnbv
