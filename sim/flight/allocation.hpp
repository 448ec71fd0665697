// From torque and thrust to rotors, for any layout of four to eight: the allocation matrix and its
// pseudo-inverse, normalised as PX4's (ControlAllocationPseudoInverse.cpp).
#pragma once

#include <string>

#include "sim/flight/vehicle_config.hpp"

namespace gnbv {

/// Of a unit of normalised torque about one body axis.
struct TorqueAllocation {
  RotorValues command{};  // what it asks of each rotor
  RotorValues share{};    // what of it each rotor's command gives, times `share_divisor`
  double share_divisor = 1.0;
};

struct Allocation {
  std::size_t rotors = 0;
  std::array<TorqueAllocation, 3> torque{};  // about body x, y, z: roll, pitch, yaw
  RotorValues thrust{};                      // without torque; its mean is 1
};

/// Quads in an X, their four arms about equal and within 20 degrees of the diagonals, are allocated
/// by the quadrant of each rotor alone, as PX4's mixers do. Throws BrokenInvariant where
/// allocation_fault() has something to say.
Allocation allocation_of(const AirframeParameters& airframe);

/// Why these rotors cannot steer a vehicle in one sentence; empty if they can.
std::string allocation_fault(const AirframeParameters& airframe);

}  // namespace gnbv
