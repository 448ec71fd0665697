#include "sim/flight/takeoff.hpp"

#include <algorithm>
#include <limits>

namespace gnbv {

Takeoff next(const Takeoff& takeoff, const CommanderParameters& parameters, bool is_armed,
             bool is_landed, bool wants_takeoff, double dt_s) {
  if (!is_armed) return {};
  Takeoff after = takeoff;
  after.spooled_s += dt_s;
  if (after.phase == TakeoffPhase::disarmed) after = {TakeoffPhase::spool_up, 0.0, 0.0};
  const double half_step_s = 0.5 * dt_s;  // times are whole steps, but their sums are rounded
  if (after.phase == TakeoffPhase::spool_up &&
      after.spooled_s > parameters.spool_up_s - half_step_s) {
    after.phase = TakeoffPhase::ready;
  }
  if (after.phase == TakeoffPhase::ready && wants_takeoff) {
    after.phase = TakeoffPhase::ramp;
    after.ramp_share = 0.0;
  } else if (after.phase == TakeoffPhase::ramp) {
    if (parameters.takeoff_ramp_s > dt_s)
      after.ramp_share = std::min(1.0, after.ramp_share + dt_s / parameters.takeoff_ramp_s);
    else
      after.ramp_share = 1.0;
    if (after.ramp_share >= 1.0) after.phase = TakeoffPhase::flight;
  } else if (after.phase == TakeoffPhase::flight && is_landed) {
    after.phase = TakeoffPhase::ready;
  }
  return after;
}

double climb_limit_m_s(const Takeoff& takeoff, double gravity_m_s2, double velocity_p_per_s,
                       double climb_max_m_s) {
  if (takeoff.phase == TakeoffPhase::flight) return climb_max_m_s;
  constexpr double kGainMin = 0.01;
  const double start_m_s = -gravity_m_s2 / std::max(velocity_p_per_s, kGainMin);
  const double share = takeoff.phase == TakeoffPhase::ramp ? takeoff.ramp_share : 0.0;
  return start_m_s + share * (climb_max_m_s - start_m_s);
}

}  // namespace gnbv
