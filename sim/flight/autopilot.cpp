#include "sim/flight/autopilot.hpp"

#include <algorithm>

namespace gnbv {

AttitudeSetpoint position_loop(const AutopilotParameters& parameters,
                               const AirframeParameters& airframe, const FlightEnvelope& envelope,
                               PositionControlMemory& memory, const VehicleState& state,
                               const Setpoint& setpoint) {
  AutopilotParameters narrowed = parameters;
  narrowed.climb_speed_max_m_s = envelope.climb_speed_max_m_s;
  narrowed.descent_speed_max_m_s =
      std::max(parameters.descent_speed_max_m_s, -envelope.climb_speed_max_m_s);
  narrowed.tilt_max_rad = envelope.tilt_max_rad;
  narrowed.thrust_min = envelope.thrust_min;
  return position_control(narrowed, airframe.gravity_m_s2, hover_command(airframe), memory, state,
                          setpoint, kPositionLoop_s);
}

RotorCommands rate_loop(const AutopilotParameters& parameters, const Allocation& allocation,
                        RateControlMemory& memory, const Vec3& omega_body_rad_s,
                        const Vec3& omega_setpoint_body_rad_s, double thrust) {
  const Vec3 torque =
      rate_control(parameters, memory, omega_body_rad_s, omega_setpoint_body_rad_s, kRateStep_s);
  const MixerOutput mixed = mix(allocation, torque, thrust);
  for (int i = 0; i < 3; ++i) {
    const double missing = torque[i] - mixed.torque[i];
    constexpr double kRounding = 1e-7;  // FLT_EPSILON in PX4
    memory.saturation[i] = missing > kRounding ? 1 : (missing < -kRounding ? -1 : 0);
  }
  return mixed.commands;
}

}  // namespace gnbv
