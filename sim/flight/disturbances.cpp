#include "sim/flight/disturbances.hpp"

#include <algorithm>
#include <cmath>

#include "sim/core/rng.hpp"

namespace gnbv {
namespace {

constexpr double kFoot_m = 0.3048;
constexpr double kGustSpeedMin_m_s = 1.0;

/// Two lags in a row, z1' = -z1 + n and z2' = -z2 + z1 with white noise n of unit density, have the
/// covariance P = [1/2 1/4; 1/4 1/4] when stationary. Over a time t they turn by
/// F = exp(-t) [1 0; t 1] and take up noise of covariance P - F P F'.
Eigen::Vector2d after(const Eigen::Vector2d& z, double t, double n1, double n2) {
  const double decay = std::exp(-t);
  const double e = decay * decay;
  const double q11 = -0.5 * std::expm1(-2.0 * t);
  const double q12 = 0.25 - e * (0.25 + 0.5 * t);
  const double q22 = 0.25 - e * (0.25 + 0.5 * t + 0.5 * t * t);
  const double l11 = std::sqrt(q11);
  const double l21 = l11 > 0.0 ? q12 / l11 : 0.0;
  const double l22 = std::sqrt(std::max(0.0, q22 - l21 * l21));
  return {decay * z[0] + l11 * n1, decay * (t * z[0] + z[1]) + l21 * n1 + l22 * n2};
}

constexpr double kMocapPosition_m = 0.001;
constexpr double kMocapAngle_rad = deg_to_rad(0.1);
constexpr double kFloatFrequency_rad_s = 0.5;
constexpr double kVioCorrelation_m = 100.0;

/// x, y, z in metres, heading in radians.
Eigen::Vector4d sigma_of(const EstimateConfig& config) {
  if (config.model != EstimateModel::rtk) return {0.5, 0.5, 0.5, deg_to_rad(2.0)};
  const RtkParameters& rtk = config.rtk;
  return {rtk.horizontal_m, rtk.horizontal_m, rtk.vertical_m, rtk.heading_rad};
}

/// What a tick adds to the rate of e'' + 2 w e' + w^2 e = noise of spectral density 4 w^3 sigma^2.
Eigen::Vector4d kick(const Eigen::Vector4d& e, const Eigen::Vector4d& rate_per_s, double w,
                     const Eigen::Vector4d& sigma_noise) {
  const Eigen::Vector4d noise = std::sqrt(4.0 * w * w * w * kTick_s) * sigma_noise;
  return noise - kTick_s * (2.0 * w * rate_per_s + w * w * e);
}

Eigen::Vector4d vio_sigma_per_m() {
  const double each_axis = 0.01 / std::sqrt(3.0);
  return {each_axis, each_axis, each_axis, deg_to_rad(0.01)};
}

}  // namespace

GustLaw low_altitude_gusts(double w20_m_s, double height_m) {
  const double height_ft = std::clamp(height_m / kFoot_m, 10.0, 1000.0);
  const double ratio = 0.177 + 0.000823 * height_ft;
  const double sigma_up_m_s = 0.1 * w20_m_s;
  const double sigma_level_m_s = sigma_up_m_s / std::pow(ratio, 0.4);
  const double length_up_m = height_ft * kFoot_m;
  const double length_level_m = length_up_m / std::pow(ratio, 1.2);
  return {{sigma_level_m_s, sigma_level_m_s, sigma_up_m_s},
          {length_level_m, length_level_m, length_up_m}};
}

UnitGusts::UnitGusts(std::uint64_t seed) : seed_(seed), along_(normal(0)) {
  constexpr double kForever = 50.0;  // scale times: nothing is left of where it began
  for (std::size_t i = 0; i < lags_.size(); ++i) {
    lags_[i] = after(Eigen::Vector2d::Zero(), kForever, normal(1 + 2 * i), normal(2 + 2 * i));
  }
}

double UnitGusts::normal(std::uint64_t index) const {
  return standard_normal({seed_, Stream::gust, tick_, index});
}

void UnitGusts::step(const Vec3& scale_times) {
  ++tick_;  // the constructor has used the numbers of tick 0
  along_ = std::exp(-scale_times[0]) * along_ +
           std::sqrt(-std::expm1(-2.0 * scale_times[0])) * normal(0);
  for (std::size_t i = 0; i < lags_.size(); ++i) {
    lags_[i] =
        after(lags_[i], scale_times[static_cast<int>(i) + 1], normal(1 + 2 * i), normal(2 + 2 * i));
  }
}

Vec3 UnitGusts::value() const {
  // (1 + sqrt(3) s) / (1 + s)^2 = sqrt(3) / (1 + s) + (1 - sqrt(3)) / (1 + s)^2
  const double root3 = std::sqrt(3.0);
  const auto lead = [&](const Eigen::Vector2d& z) { return root3 * z[0] + (1.0 - root3) * z[1]; };
  return {along_, lead(lags_[0]), lead(lags_[1])};
}

Wind::Wind(const WindConfig& config, std::uint64_t seed) : config_(config), gusts_(seed) {
  const Vec3& mean_m_s = config.mean_world_m_s;
  // along x, east, when the mean wind has no level part
  const double angle_rad =
      mean_m_s.head<2>().norm() > 0.0 ? std::atan2(mean_m_s.y(), mean_m_s.x()) : 0.0;
  R_world_wind_ = Eigen::AngleAxisd(angle_rad, Vec3::UnitZ()).toRotationMatrix();
}

Vec3 Wind::step(const Vec3& p_world_m, const Vec3& v_world_m_s) {
  if (config_.gust_w20_m_s <= 0.0) return config_.mean_world_m_s;
  const GustLaw law = low_altitude_gusts(config_.gust_w20_m_s, p_world_m.z());
  const double speed_m_s =
      std::max(kGustSpeedMin_m_s, (v_world_m_s - config_.mean_world_m_s).norm());
  gusts_.step(kTick_s * speed_m_s * law.length_m.cwiseInverse());
  return config_.mean_world_m_s + R_world_wind_ * law.sigma_m_s.cwiseProduct(gusts_.value());
}

StateEstimator::StateEstimator(const EstimateConfig& config, std::uint64_t seed,
                               const VehicleState& start)
    : config_(config), seed_(seed), p_last_world_m_(start.T_world_body.translation()) {
  if (is_by_satellites(config_.model)) {
    if (config_.model == EstimateModel::rtk) frequency_rad_s_ = 2.0 / config_.rtk.correlation_s;
    // position and rate of the stationary process are independent, sigma_rate = frequency * sigma
    error_ = sigma_of(config_).cwiseProduct(normals(4));
    error_rate_per_s_ = (sigma_of(config_) * frequency_rad_s_).cwiseProduct(normals(8));
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
  const Vec4 noise = normals();
  error_rate_per_s_ +=
      kick(error_, error_rate_per_s_, frequency_rad_s_, sigma_of(config_).cwiseProduct(noise));
  if (config_.model == EstimateModel::rtk) wander_afloat();
  if (is_in_outage()) {
    error_rate_per_s_.head<3>().setZero();
    float_rate_m_s_.setZero();
    walk_m_ += config_.outage_drift_m_per_sqrt_s * std::sqrt(kTick_s) * noise.head<3>();
  } else {
    walk_m_ *= std::exp(-kTick_s / kOutageFade_s);
  }
  error_ += kTick_s * error_rate_per_s_;
  float_m_ += kTick_s * float_rate_m_s_;
}

void StateEstimator::wander_afloat() {
  const RtkParameters& rtk = config_.rtk;
  const double mean_s = is_float_ ? rtk.float_mean_s : rtk.fixed_mean_s;
  const double chance = -std::expm1(-kTick_s / mean_s);
  if (uniform01({seed_, Stream::pose_noise, tick_, 12}) < chance) is_float_ = !is_float_;
  const double sigma_m = is_float_ ? rtk.float_m : 0.0;
  float_rate_m_s_ += kick(float_m_, float_rate_m_s_, kFloatFrequency_rad_s, sigma_m * normals(4));
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
  if (config_.model == EstimateModel::none) return truth;
  if (config_.model == EstimateModel::mocap) return with_jitter(truth);
  if (is_by_satellites(config_.model)) wander();
  if (config_.model == EstimateModel::vio) drift(truth);
  VehicleState estimate = truth;
  estimate.T_world_body.linear() =
      Eigen::AngleAxisd(error_[3], Vec3::UnitZ()) * truth.T_world_body.linear();
  estimate.T_world_body.translation() += (error_ + float_m_).head<3>();
  estimate.v_world_m_s += (error_rate_per_s_ + float_rate_m_s_).head<3>();
  if (config_.outages.empty()) return estimate;
  estimate.T_world_body.translation() += walk_m_;
  if (!is_in_outage()) estimate.v_world_m_s -= walk_m_ / kOutageFade_s;  // it fades
  return estimate;
}

}  // namespace gnbv
