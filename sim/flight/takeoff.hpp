// PX4's smooth takeoff (Takeoff.cpp): armed rotors spool up, wait for somebody who wants to fly,
// and are then let go along a ramp of the climb limit.
#pragma once

#include "sim/flight/commander_parameters.hpp"

namespace gnbv {

enum class TakeoffPhase { disarmed, spool_up, ready, ramp, flight };

struct Takeoff {
  TakeoffPhase phase = TakeoffPhase::disarmed;
  double spooled_s = 0.0;  // since arming
  double ramp_share = 0.0;
};

/// One step of `dt_s`. A landing puts the vehicle back to `ready`, disarming to `disarmed`.
Takeoff next(const Takeoff& takeoff, const CommanderParameters& parameters, bool is_armed,
             bool is_landed, bool wants_takeoff, double dt_s);

/// The climb limit, towards `climb_max_m_s`. The ramp starts at the downward velocity -g / P at
/// which the velocity loop (gain `velocity_p_per_s`) gives no thrust at all.
double climb_limit_m_s(const Takeoff& takeoff, double gravity_m_s2, double velocity_p_per_s,
                       double climb_max_m_s);

}  // namespace gnbv
