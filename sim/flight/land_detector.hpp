// PX4's land detector for multicopters (MulticopterLandDetector.cpp): three stages, each of which
// has to hold for a third of LNDMC_TRIG_TIME before the next may begin.
#pragma once

#include "sim/flight/commander_parameters.hpp"
#include "sim/flight/flight.hpp"

namespace gnbv {

struct LandDetector {
  double contact_s = 0.0;  // how long the condition of each stage has held
  double maybe_s = 0.0;
  double landed_s = 0.0;
  bool has_ground_contact = false;  // told to descend, little thrust, and still not moving
  bool is_maybe_landed = false;     // no thrust, and not turning
  bool is_landed = false;
};

/// The detector of a vehicle that stands on the ground.
constexpr LandDetector kOnGround = {0.0, 0.0, 0.0, true, true, true};

struct LandEvidence {
  bool is_armed = false;
  bool is_told_to_descend = false;  // velocity setpoint below -0.3 m/s
  double thrust = 0.0;              // command, of [0, 1]
  double thrust_min = 0.0;
  double hover_thrust = 0.5;
};

/// One step of `dt_s`. A disarmed vehicle counts as landed at once.
LandDetector next(const LandDetector& detector, const CommanderParameters& parameters,
                  const LandEvidence& evidence, const VehicleState& estimate, double dt_s);

/// Whether this setpoint asks for a descent in the sense of the detector: by velocity.
bool asks_for_descent(const Setpoint& setpoint);

}  // namespace gnbv
