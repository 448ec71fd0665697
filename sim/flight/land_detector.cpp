#include "sim/flight/land_detector.hpp"

#include <cmath>

namespace gnbv {
namespace {

// MulticopterLandDetector.cpp: shares of the range from least to hover thrust (hover thrust is
// known here), and how much wider the limits of motion are once the vehicle may have landed
constexpr double kLowThrustShare = 0.6;
constexpr double kNoThrustShare = 0.1;
constexpr double kWidened = 2.5;
constexpr double kDescentSpeed_m_s = 0.3;

/// Whether `condition` has held for `needed_s`.
bool has_held(bool condition, double needed_s, double dt_s, double& held_s) {
  held_s = condition ? held_s + dt_s : 0.0;
  return condition && held_s > needed_s - 0.5 * dt_s;
}

}  // namespace

bool asks_for_descent(const Setpoint& setpoint) {
  return setpoint.v_world_m_s.z() < -kDescentSpeed_m_s;  // NaN: no
}

LandDetector next(const LandDetector& detector, const CommanderParameters& parameters,
                  const LandEvidence& evidence, const VehicleState& estimate, double dt_s) {
  if (!evidence.is_armed) return kOnGround;
  const double widened = detector.is_maybe_landed ? kWidened : 1.0;
  const auto thrust_below = [&](double share) {
    return evidence.thrust <=
           evidence.thrust_min + share * (evidence.hover_thrust - evidence.thrust_min);
  };
  const bool is_still =
      std::abs(estimate.v_world_m_s.z()) <= widened * parameters.land_speed_vertical_max_m_s &&
      estimate.v_world_m_s.head<2>().norm() <= parameters.land_speed_horizontal_max_m_s;
  const bool is_turning =
      estimate.omega_body_rad_s.head<2>().norm() > widened * parameters.land_rotation_max_rad_s;
  const bool may_be_down =
      evidence.is_told_to_descend || detector.is_maybe_landed || detector.is_landed;

  // a stage that was reached already is lost, but not waited for again
  const double stage_s = parameters.land_detection_s / 3.0;
  const auto needed_s = [&](bool is_reached) { return is_reached ? 0.0 : stage_s; };
  LandDetector after = detector;
  after.has_ground_contact = has_held(may_be_down && thrust_below(kLowThrustShare) && is_still,
                                      needed_s(detector.has_ground_contact), dt_s, after.contact_s);
  after.is_maybe_landed =
      has_held(after.has_ground_contact && thrust_below(kNoThrustShare) && !is_turning,
               needed_s(detector.is_maybe_landed), dt_s, after.maybe_s);
  after.is_landed =
      has_held(after.is_maybe_landed, needed_s(detector.is_landed), dt_s, after.landed_s);
  return after;
}

}  // namespace gnbv
