// The PX4 cascade around the controllers: from setpoint to attitude, and from body rate to rotor
// commands.
#pragma once

#include "sim/flight/attitude_control.hpp"
#include "sim/flight/mixer.hpp"

namespace gnbv {

/// Position and velocity loops at 50 Hz, attitude at every 4 ms tick, rate and mixer at 1 kHz.
constexpr int kTicksPerPositionLoop = 5;
constexpr double kPositionLoop_s = kTicksPerPositionLoop * kTick_s;

/// The limits of the position loop that a phase of flight narrows. A climb limit below zero asks
/// for a descent at that speed at least.
struct FlightEnvelope {
  double climb_speed_max_m_s;
  double tilt_max_rad;
  double thrust_min;
};

/// Position and velocity loops. Hover thrust is the true hover command, held constant: PX4's hover
/// thrust estimator would converge to it.
AttitudeSetpoint position_loop(const AutopilotParameters& parameters,
                               const AirframeParameters& airframe, const FlightEnvelope& envelope,
                               PositionControlMemory& memory, const VehicleState& state,
                               const Setpoint& setpoint);

/// Rate loop and mixer, kRateStep_s after the last.
RotorCommands rate_loop(const AutopilotParameters& parameters, const Allocation& allocation,
                        RateControlMemory& memory, const Vec3& omega_body_rad_s,
                        const Vec3& omega_setpoint_body_rad_s, double thrust);

}  // namespace gnbv
