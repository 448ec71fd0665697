#include "sim/autopilot.hpp"

namespace gnbv {

RotorCommands autopilot(const AutopilotParameters& parameters, const AirframeParameters& airframe,
                        AutopilotMemory& memory, std::int64_t tick, const VehicleState& state,
                        const Setpoint& setpoint) {
  if (tick % kTicksPerPositionLoop == 0) {
    memory.attitude_setpoint =
        position_control(parameters, airframe.gravity_m_s2, hover_command(airframe),
                         memory.position, state, setpoint, kTicksPerPositionLoop * kTick_s);
  }
  const Eigen::Quaterniond q_world_body(state.T_world_body.linear());
  const Vec3 omega_setpoint = attitude_control(parameters, q_world_body, memory.attitude_setpoint);
  const Vec3 torque =
      rate_control(parameters, memory.rate, state.omega_body_rad_s, omega_setpoint, kTick_s);
  const MixerOutput mixed = mix(airframe, torque, memory.attitude_setpoint.thrust);
  for (int i = 0; i < 3; ++i) {
    const double missing = torque[i] - mixed.torque[i];
    constexpr double kRounding = 1e-7;  // FLT_EPSILON in PX4
    memory.rate.saturation[i] = missing > kRounding ? 1 : (missing < -kRounding ? -1 : 0);
  }
  return mixed.commands;
}

}  // namespace gnbv
