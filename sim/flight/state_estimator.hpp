// What the vehicle believes about its own state: the truth with the error of a named source.
#pragma once

#include <cstdint>

#include "sim/flight/flight.hpp"

namespace gnbv {

/// After an outage, what it has left fades by exp(-t / kOutageFade_s).
constexpr double kOutageFade_s = 2.0;

/// The body rate is always true. Errors are keyed by seed and tick: a flight flown again is the
/// same.
/// none: the truth, as the paper assumes.
/// mocap: 1 mm and 0.1 deg (sigma, each axis), fresh at every tick.
/// gnss: 0.5 m of position (sigma, each axis; EKF2_GPS_P_NOISE) and 2 deg of heading. They wander
///   as critically damped second-order Gauss-Markov processes of 0.05 rad/s (a correlation time of
///   some 40 s, own choice) from their stationary law on; the velocity error is the position
///   error's derivative. In an outage the position error stands still and a random walk of variance
///   outage_drift^2 t grows on it (dead reckoning by a velocity whose error is white). It fades
///   when the satellites are back, as in a filter that trusts them again (kOutageFade_s, own
///   choice). The heading, of a compass, wanders on.
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
  void drift(const VehicleState& truth);
  VehicleState with_error(const VehicleState& truth) const;
  VehicleState with_jitter(const VehicleState& truth) const;

  EstimateConfig config_;
  std::uint64_t seed_;
  std::uint64_t tick_ = 0;
  Vec3 p_last_world_m_;
  Vec4 error_ = Vec4::Zero();
  Vec4 error_rate_per_s_ = Vec4::Zero();  // gnss
  Vec3 walk_m_ = Vec3::Zero();            // gnss: what outages have left
  Vec4 drift_per_m_ = Vec4::Zero();       // vio
};

}  // namespace gnbv
