#include "sim/flight/wind.hpp"

#include <algorithm>
#include <cmath>

#include "sim/core/rng.hpp"
#include "sim/flight/flight.hpp"

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

}  // namespace gnbv
