// What a flight will take from the battery, foretold in still air.
#pragma once

#include "sim/core/pose.hpp"

namespace gnbv {

struct GuidanceConfig;
struct VehicleConfig;

/// Power in a still hover: PowerParameters' law at a thrust of the weight.
double hover_power_w(const VehicleConfig& vehicle);

/// Energy of a straight leg from rest to rest, turned the short way meanwhile: the power at the
/// leg's mean velocity and a thrust of the weight, at least the hover power, for as long as its
/// reference takes and kArrival_s more. Nothing where it neither moves nor turns.
double leg_energy_wh(const VehicleConfig& vehicle, const GuidanceConfig& guidance,
                     const ViewPose& from, const ViewPose& to);

/// A quadrotor comes to rest so much later than its reference (measured: 0.5 s to 1.9 s).
constexpr double kArrival_s = 2.0;

/// Energy of a descent straight down from `height_m` at PX4's slow landing speed, and of the
/// seconds that the land detector and the disarming take.
double landing_energy_wh(const VehicleConfig& vehicle, double height_m);

}  // namespace gnbv
