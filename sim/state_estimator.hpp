// What the vehicle believes about its own state: the truth with the error of a named source.
#pragma once

#include <cstdint>

#include "sim/flight.hpp"

namespace gnbv {

/// none: the truth, as the paper assumes.
/// mocap: 1 mm and 0.1 deg (sigma, each axis), fresh at every tick.
/// gnss: position error of 0.5 m (sigma, each axis; EKF2_GPS_P_NOISE) that wanders with a time
///   constant of 60 s, the velocity error that goes with it, heading 1 deg with the same constant.
/// vio: position drifts by 1 % of the path flown (root mean square over missions, for paths short
///   against the 100 m over which the drift changes its direction); roll and pitch are observable
///   and stay true, the heading drifts with the position: 0.01 deg a metre.
/// Errors begin at zero for `vio` and at their stationary law otherwise, and are keyed by seed and
/// tick: a flight repeated is the same flight.
class StateEstimator {
 public:
  StateEstimator(const EstimateConfig& config, std::uint64_t seed, const VehicleState& start);

  /// The estimate at the next tick. Call once a tick, in order.
  VehicleState step(const VehicleState& truth);

 private:
  EstimateConfig config_;
  std::uint64_t seed_;
  std::uint64_t tick_ = 0;
  Vec3 p_last_world_m_;
  Vec3 position_error_m_ = Vec3::Zero();
  Vec3 drift_per_m_ = Vec3::Zero();
  double yaw_error_rad_ = 0.0;
  double yaw_drift_rad_per_m_ = 0.0;
};

}  // namespace gnbv
