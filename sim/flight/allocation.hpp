// From torque and thrust to rotors, for any layout of four to eight: PX4's control allocation.
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

/// The pseudo-inverse of the allocation matrix, normalised as PX4's
/// (ControlAllocationPseudoInverse.cpp). Quads in an X, their four arms about equal and within 20
/// degrees of the diagonals, are allocated by the quadrant of each rotor alone, as PX4's mixers do.
/// Throws BrokenInvariant where allocation_fault() names a fault.
Allocation allocation_of(const AirframeParameters& airframe);

/// One sentence: why these rotors cannot steer a vehicle. Empty if they can.
std::string allocation_fault(const AirframeParameters& airframe);

struct MixerOutput {
  RotorCommands commands{};
  Vec3 torque = Vec3::Zero();  // the normalised torque that these commands give
};

/// PX4's sequential desaturation with airmode off (ControlAllocationSequentialDesaturation.cpp):
/// yaw gives way first, then thrust, then roll and pitch. `torque`: normalised, body axes. `thrust`
/// in [0, 1].
MixerOutput mix(const Allocation& allocation, const Vec3& torque, double thrust);

}  // namespace gnbv
