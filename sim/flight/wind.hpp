// The air: a mean wind that is the same everywhere, and Dryden's gusts at the vehicle. Source:
// MIL-F-8785C (1980), section 3.7, continuous gusts and the low-altitude model. MIL-HDBK-1797
// writes the same spectra with halved lateral and vertical lengths.
#pragma once

#include <array>
#include <cstdint>

#include "sim/core/pose.hpp"

namespace gnbv {

struct WindConfig {
  Vec3 mean_world_m_s = Vec3::Zero();  // velocity of the air: [3, 0, 0] blows towards the east
  double gust_w20_m_s = 0.0;           // wind 20 ft above the ground that makes the gusts; 0: none
};

/// Standard deviations and scale lengths of the gusts along the mean wind, across it and upwards.
struct GustLaw {
  Vec3 sigma_m_s = Vec3::Zero();
  Vec3 length_m = Vec3::Ones();
};

/// The low-altitude model, stated for 10 ft to 1,000 ft above the ground. Heights beyond take the
/// law of the nearer end.
GustLaw low_altitude_gusts(double w20_m_s, double height_m);

/// Gusts of unit variance that pass the vehicle. Dryden's forming filters in time over scale time,
/// 1 / (1 + s) along and (1 + sqrt(3) s) / (1 + s)^2 across and upwards, are discretised exactly:
/// whatever the steps, the variance is 1 and the correlation over t scale times exp(-t) along and
/// exp(-t) (1 - t / 2) across and upwards.
class UnitGusts {
 public:
  /// In the stationary state.
  explicit UnitGusts(std::uint64_t seed);

  /// Advances the three filters by so many of their own scale times; call once a tick, in order.
  void step(const Vec3& scale_times);
  /// Along, across, up.
  Vec3 value() const;

 private:
  double normal(std::uint64_t index) const;

  std::uint64_t seed_;
  std::uint64_t tick_ = 0;
  double along_;
  std::array<Eigen::Vector2d, 2> lags_;  // of the second-order filters: one lag, and a second on it
};

/// Mean wind and gusts, keyed by seed and tick: a flight flown again meets the same air.
class Wind {
 public:
  Wind(const WindConfig& config, std::uint64_t seed);

  /// Velocity of the air during the next tick at a vehicle with that true place and velocity. The
  /// gusts are frozen: they pass at the vehicle's speed through the mean wind, at least 1 m/s (own
  /// choice, for a vehicle that drifts with the wind). The height of their law is z, over terrain
  /// too.
  Vec3 step(const Vec3& p_world_m, const Vec3& v_world_m_s);

 private:
  WindConfig config_;
  Eigen::Matrix3d R_world_wind_;  // axes: along the level part of the mean wind, across, up
  UnitGusts gusts_;
};

}  // namespace gnbv
