// PX4's sequential desaturation with airmode off (ControlAllocationSequentialDesaturation.cpp):
// thrust gives way first, then roll and pitch, and before any of them yaw.
#pragma once

#include "sim/flight/allocation.hpp"
#include "sim/flight/rotors.hpp"

namespace gnbv {

struct MixerOutput {
  RotorCommands commands{};    // in [0, 1]
  Vec3 torque = Vec3::Zero();  // the normalised torque that these commands give
};

/// `torque`: normalised, body axes. `thrust` in [0, 1].
MixerOutput mix(const Allocation& allocation, const Vec3& torque, double thrust);

}  // namespace gnbv
