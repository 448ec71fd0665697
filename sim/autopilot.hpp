// The whole PX4 cascade, airborne: setpoint and state in, rotor commands out, once per tick.
#pragma once

#include "sim/attitude_control.hpp"
#include "sim/mixer.hpp"

namespace gnbv {

/// Position and velocity loops at 50 Hz, attitude, rate and mixer at every 4 ms tick (250 Hz is
/// what Gazebo's lockstep yields).
constexpr int kTicksPerPositionLoop = 5;

struct AutopilotMemory {
  PositionControlMemory position;
  RateControlMemory rate;
  AttitudeSetpoint attitude_setpoint;
};

/// One tick. `tick` counts from the start; the state estimate is the truth. Hover thrust is the
/// true hover command, held constant: PX4's hover thrust estimator would converge to it.
RotorCommands autopilot(const AutopilotParameters& parameters, const AirframeParameters& airframe,
                        AutopilotMemory& memory, std::int64_t tick, const VehicleState& state,
                        const Setpoint& setpoint);

}  // namespace gnbv
