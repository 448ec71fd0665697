// What a companion computer that knows its vehicle sends along with position and velocity, so that
// the autopilot has nothing left to correct.
#pragma once

#include "sim/flight/vehicle_config.hpp"

namespace gnbv {

/// The acceleration setpoint at which the cascade, without error and integral, moves the vehicle
/// with this velocity and acceleration: the laws of the rotors and of position_control, solved for
/// it. Covers rotor drag, lost thrust, the thrust's square law and the loop's derivative term.
Vec3 acceleration_setpoint(const AirframeParameters& airframe, const AutopilotParameters& autopilot,
                           const Vec3& v_world_m_s, const Vec3& a_world_m_s2);

/// How much later than the setpoint the tilt follows.
double attitude_lag_s(const AutopilotParameters& autopilot);

}  // namespace gnbv
