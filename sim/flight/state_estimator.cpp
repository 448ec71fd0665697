#include "sim/flight/state_estimator.hpp"

#include <algorithm>
#include <cmath>

#include "sim/core/error.hpp"
#include "sim/core/rng.hpp"

namespace gnbv {
namespace {

using Vec4 = Eigen::Vector4d;

constexpr double kMocapPosition_m = 0.001;
constexpr double kMocapAngle_rad = deg_to_rad(0.1);

constexpr double kGnssPosition_m = 0.5;
constexpr double kGnssHeading_rad = deg_to_rad(2.0);
constexpr double kGnssFrequency_rad_s = 0.05;

constexpr double kVioDriftPerPath = 0.01;
constexpr double kVioHeading_rad_per_m = deg_to_rad(0.01);
constexpr double kVioCorrelation_m = 100.0;

Vec4 gnss_sigma() { return {kGnssPosition_m, kGnssPosition_m, kGnssPosition_m, kGnssHeading_rad}; }

Vec4 vio_sigma_per_m() {
  const double each_axis = kVioDriftPerPath / std::sqrt(3.0);
  return {each_axis, each_axis, each_axis, kVioHeading_rad_per_m};
}

}  // namespace

StateEstimator::StateEstimator(const EstimateConfig& config, std::uint64_t seed,
                               const VehicleState& start)
    : config_(config), seed_(seed), p_last_world_m_(start.T_world_body.translation()) {
  if (config_.model == EstimateModel::gnss) {
    // position and rate of the stationary process are independent, sigma_rate = frequency * sigma
    for (int i = 0; i < 4; ++i) {
      error_[i] = gnss_sigma()[i] * normal(static_cast<std::uint64_t>(4 + i));
      error_rate_per_s_[i] =
          gnss_sigma()[i] * kGnssFrequency_rad_s * normal(static_cast<std::uint64_t>(8 + i));
    }
  }
  if (config_.model == EstimateModel::vio) drift_per_m_ = vio_sigma_per_m().cwiseProduct(normals());
}

double StateEstimator::normal(std::uint64_t index) const {
  return standard_normal({seed_, Stream::pose_noise, tick_, index});
}

StateEstimator::Vec4 StateEstimator::normals() const {
  return {normal(0), normal(1), normal(2), normal(3)};
}

bool StateEstimator::is_in_outage() const {
  const double time_s = static_cast<double>(tick_) * kTick_s;
  return std::any_of(config_.outages.begin(), config_.outages.end(), [&](const GnssOutage& outage) {
    return time_s > outage.start_s && time_s <= outage.start_s + outage.duration_s;
  });
}

void StateEstimator::wander() {
  // e'' + 2 w e' + w^2 e = noise of spectral density 4 w^3 sigma^2
  const double w = kGnssFrequency_rad_s;
  const Vec4 noise = normals();
  const Vec4 kick = std::sqrt(4.0 * w * w * w * kTick_s) * gnss_sigma().cwiseProduct(noise);
  Vec4 rate_per_s =
      error_rate_per_s_ + (kick - kTick_s * (2.0 * w * error_rate_per_s_ + w * w * error_));
  const bool is_out = is_in_outage();
  if (is_out) {
    rate_per_s.head<3>().setZero();
    walk_m_ += config_.outage_drift_m_per_sqrt_s * std::sqrt(kTick_s) * noise.head<3>();
  }
  error_rate_per_s_ = rate_per_s;
  error_ += kTick_s * error_rate_per_s_;
  if (!is_out) walk_m_ *= std::exp(-kTick_s / kOutageFade_s);
}

void StateEstimator::drift(const VehicleState& truth) {
  const double path_m = (truth.T_world_body.translation() - p_last_world_m_).norm();
  const double kept = std::exp(-path_m / kVioCorrelation_m);
  error_ += path_m * drift_per_m_;
  drift_per_m_ = kept * drift_per_m_ +
                 std::sqrt(1.0 - kept * kept) * vio_sigma_per_m().cwiseProduct(normals());
}

VehicleState StateEstimator::with_error(const VehicleState& truth) const {
  VehicleState estimate = truth;
  estimate.T_world_body.linear() =
      Eigen::AngleAxisd(error_[3], Vec3::UnitZ()) * truth.T_world_body.linear();
  estimate.T_world_body.translation() += error_.head<3>();
  estimate.v_world_m_s += error_rate_per_s_.head<3>();
  return estimate;
}

VehicleState StateEstimator::with_outage(const VehicleState& wandered) const {
  if (config_.outages.empty()) return wandered;
  VehicleState estimate = wandered;
  estimate.T_world_body.translation() += walk_m_;
  if (!is_in_outage()) estimate.v_world_m_s -= walk_m_ / kOutageFade_s;  // it fades
  return estimate;
}

VehicleState StateEstimator::with_jitter(const VehicleState& truth) const {
  VehicleState estimate = truth;
  const Vec3 turn_rad = kMocapAngle_rad * Vec3(normal(3), normal(4), normal(5));
  const Eigen::Matrix3d R = Eigen::AngleAxisd(turn_rad.norm(), turn_rad.normalized()).matrix();
  estimate.T_world_body.linear() = R * truth.T_world_body.linear();
  estimate.T_world_body.translation() += kMocapPosition_m * Vec3(normal(0), normal(1), normal(2));
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
      return with_outage(with_error(truth));
    case EstimateModel::vio:
      drift(truth);
      error_rate_per_s_ = truth.v_world_m_s.norm() * drift_per_m_;
      p_last_world_m_ = truth.T_world_body.translation();
      return with_error(truth);
  }
  throw BrokenInvariant("estimate model outside its enumeration");
}

}  // namespace gnbv
