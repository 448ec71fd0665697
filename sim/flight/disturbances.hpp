// What disturbs a flight: the air it flies through, and the error of what the vehicle believes
// about its own state. Both are keyed by seed and tick: a flight flown again meets the same.
#pragma once

#include <array>
#include <cstdint>

#include "sim/flight/flight.hpp"

namespace gnbv {

/// Dryden's gusts of MIL-F-8785C (1980), section 3.7: standard deviations and scale lengths along
/// the mean wind, across it and upwards. MIL-HDBK-1797 has halved lateral and vertical lengths.
struct GustLaw {
  Vec3 sigma_m_s = Vec3::Zero();
  Vec3 length_m = Vec3::Ones();
};

/// The low-altitude model, stated for 10 ft to 1,000 ft above the ground; the nearer end beyond.
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

/// A mean wind that is the same everywhere, and Dryden's gusts at the vehicle.
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

/// After an outage, what it has left fades by exp(-t / kOutageFade_s).
constexpr double kOutageFade_s = 2.0;

/// What the vehicle believes: the truth with the error of a source. The body rate is always true.
/// none: the truth, as the paper assumes.
/// mocap: 1 mm and 0.1 deg (sigma, each axis), fresh at every tick.
/// gnss: 0.5 m of position (sigma, each axis; EKF2_GPS_P_NOISE) and 2 deg of heading. They wander
///   as critically damped second-order Gauss-Markov processes of 0.05 rad/s (a correlation time of
///   some 40 s, own choice) from their stationary law on; the velocity error is the position
///   error's derivative. In an outage the position error stands still and a random walk of variance
///   outage_drift^2 t grows on it (dead reckoning by a velocity whose error is white). It fades
///   when the satellites are back, as in a filter that trusts them again (kOutageFade_s, own
///   choice). The heading, of a compass, wanders on.
/// rtk: the same law with RtkParameters. While the fix is lost a process of 0.5 rad/s (own choice)
///   and sigma float_m grows on it, and decays when the fix is back. Begins with a fix.
/// vio: position drifts by 1 % of the path flown (root mean square over missions, while the path is
///   short against the 100 m after which the drift forgets its direction, own choice), heading by
///   0.01 deg a metre; roll and pitch are observable and stay true. Begins without error.
class StateEstimator {
 public:
  StateEstimator(const EstimateConfig& config, std::uint64_t seed, const VehicleState& start);

  /// The estimate for the next tick, the first call for tick 0. Call once a tick, in order.
  VehicleState step(const VehicleState& truth);

 private:
  using Vec4 = Eigen::Vector4d;  // x, y, z in metres, heading in radians

  Vec4 normals(std::uint64_t first = 0) const;
  bool is_in_outage() const;
  void wander();
  void wander_afloat();
  void drift(const VehicleState& truth);
  VehicleState with_jitter(const VehicleState& truth) const;

  EstimateConfig config_;
  std::uint64_t seed_;
  std::uint64_t tick_ = 0;
  Vec3 p_last_world_m_;
  Vec4 error_ = Vec4::Zero();
  Vec4 error_rate_per_s_ = Vec4::Zero();  // gnss, rtk
  double frequency_rad_s_ = 0.05;         // of both
  Vec3 walk_m_ = Vec3::Zero();            // of both: what outages have left
  bool is_float_ = false;                 // rtk: has lost its fix
  Vec4 float_m_ = Vec4::Zero();           // rtk: what that has left; no heading
  Vec4 float_rate_m_s_ = Vec4::Zero();
  Vec4 drift_per_m_ = Vec4::Zero();  // vio
};

}  // namespace gnbv
