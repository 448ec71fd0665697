// The PX4 cascade: setpoint and state in, rotor commands out.
#pragma once

#include "sim/attitude_control.hpp"
#include "sim/mixer.hpp"

namespace gnbv {

/// Position and velocity loops at 50 Hz, attitude, rate and mixer at every 4 ms tick (250 Hz is
/// what Gazebo's lockstep yields).
constexpr int kTicksPerPositionLoop = 5;
constexpr double kPositionLoop_s = kTicksPerPositionLoop * kTick_s;

struct AutopilotMemory {
  PositionControlMemory position;
  RateControlMemory rate;
  AttitudeSetpoint attitude_setpoint;
};

/// The limits of the position loop that a phase of flight narrows. A climb limit below zero asks
/// for a descent at that speed at least.
struct FlightEnvelope {
  double climb_speed_max_m_s;
  double tilt_max_rad;
  double thrust_min;
};
FlightEnvelope full_envelope(const AutopilotParameters& parameters);

/// Position and velocity loops. The state estimate is the truth. Hover thrust is the true hover
/// command, held constant: PX4's hover thrust estimator would converge to it.
AttitudeSetpoint position_loop(const AutopilotParameters& parameters,
                               const AirframeParameters& airframe, const FlightEnvelope& envelope,
                               PositionControlMemory& memory, const VehicleState& state,
                               const Setpoint& setpoint);

/// Rate loop and mixer, `dt_s` after the last.
RotorCommands rate_loop(const AutopilotParameters& parameters, const AirframeParameters& airframe,
                        RateControlMemory& memory, const Vec3& omega_body_rad_s,
                        const Vec3& omega_setpoint_body_rad_s, double thrust, double dt_s);

/// One tick of the whole cascade in free flight. `tick` counts from the start.
RotorCommands autopilot(const AutopilotParameters& parameters, const AirframeParameters& airframe,
                        AutopilotMemory& memory, std::int64_t tick, const VehicleState& state,
                        const Setpoint& setpoint);

}  // namespace gnbv
