#include "sim/flight/velocity_smoothing.hpp"

#include <algorithm>
#include <cmath>

namespace gnbv {
namespace {

/// The signed jerk of the first phase: away from the speed that would be reached by braking the
/// acceleration at once, towards the wanted one.
double first_jerk(const SmoothedAxis& now, double dv_m_s, const AxisLimits& limits) {
  const double dv_braking_m_s = now.a_m_s2 * std::abs(now.a_m_s2) / (2.0 * limits.jerk_m_s3);
  return dv_m_s >= dv_braking_m_s ? limits.jerk_m_s3 : -limits.jerk_m_s3;
}

/// The change that goes through the acceleration `peak`, or as far as its limit; the middle phase
/// fills up what is missing of the speed.
SpeedChange through_peak(const SmoothedAxis& now, double dv_m_s, double jerk_m_s3, double peak,
                         double a_max_m_s2) {
  const double a1 = std::clamp(peak, -a_max_m_s2, a_max_m_s2);
  SpeedChange change;
  change.jerk_m_s3 = jerk_m_s3;
  change.t1_s = std::max(0.0, (a1 - now.a_m_s2) / jerk_m_s3);
  const double reached = now.a_m_s2 + jerk_m_s3 * change.t1_s;
  change.t3_s = std::max(0.0, reached / jerk_m_s3);
  const double dv_outer_m_s =
      0.5 * (now.a_m_s2 + reached) * change.t1_s + 0.5 * reached * change.t3_s;
  if (std::abs(reached) > 1e-9) {
    change.t2_s = std::max(0.0, (dv_m_s - dv_outer_m_s) / reached);
  }
  return change;
}

}  // namespace

SpeedChange fastest_change(const SmoothedAxis& now, double v_m_s, const AxisLimits& limits) {
  const double dv_m_s = v_m_s - now.v_m_s;
  const double jerk = first_jerk(now, dv_m_s, limits);
  // without a middle phase a1^2 / j - a0^2 / (2 j) = dv, PX4's T1 = (a1 - a0) / j
  const double squared = jerk * dv_m_s + 0.5 * now.a_m_s2 * now.a_m_s2;
  const double peak = std::copysign(std::sqrt(std::max(0.0, squared)), jerk);
  return through_peak(now, dv_m_s, jerk, peak, limits.a_max_m_s2);
}

SpeedChange stretched_change(const SmoothedAxis& now, double v_m_s, const AxisLimits& limits,
                             double duration_s) {
  const double dv_m_s = v_m_s - now.v_m_s;
  const double jerk = first_jerk(now, dv_m_s, limits);
  // T1 + T2 + T3 = T gives a1^2 - a1 (j T + a0) + j dv + a0^2 / 2 = 0; the root nearer to zero
  const double sum = jerk * duration_s + now.a_m_s2;
  const double squared = sum * sum - 4.0 * jerk * dv_m_s - 2.0 * now.a_m_s2 * now.a_m_s2;
  if (squared < 0.0) return fastest_change(now, v_m_s, limits);
  const double peak = 0.5 * (sum - std::copysign(std::sqrt(squared), jerk));
  return through_peak(now, dv_m_s, jerk, peak, limits.a_max_m_s2);
}

SmoothedAxis advance(const SmoothedAxis& now, const SpeedChange& change, double dt_s) {
  SmoothedAxis axis = now;
  const auto move = [&](double jerk, double t) {
    axis.x_m += t * (axis.v_m_s + t * (axis.a_m_s2 / 2.0 + t * jerk / 6.0));
    axis.v_m_s += t * (axis.a_m_s2 + t * jerk / 2.0);
    axis.a_m_s2 += t * jerk;
  };
  const double t1 = std::min(dt_s, change.t1_s);
  const double t2 = std::min(dt_s - t1, change.t2_s);
  const double t3 = std::min(dt_s - t1 - t2, change.t3_s);
  move(change.jerk_m_s3, t1);
  move(0.0, t2);
  move(-change.jerk_m_s3, t3);
  if (dt_s >= change.duration_s()) axis.a_m_s2 = 0.0;
  move(0.0, dt_s - t1 - t2 - t3);
  return axis;
}

std::array<SmoothedAxis, 3> advance_together(const std::array<SmoothedAxis, 3>& axes,
                                             const std::array<double, 3>& v_m_s,
                                             const std::array<AxisLimits, 3>& limits, double dt_s) {
  double longest_s = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    longest_s = std::max(longest_s, fastest_change(axes[i], v_m_s[i], limits[i]).duration_s());
  }
  std::array<SmoothedAxis, 3> after;
  for (std::size_t i = 0; i < 3; ++i) {
    after[i] = advance(axes[i], stretched_change(axes[i], v_m_s[i], limits[i], longest_s), dt_s);
  }
  return after;
}

double braking_speed_m_s(double distance_m, const AxisLimits& limits) {
  const double b = 4.0 * limits.a_max_m_s2 * limits.a_max_m_s2 / limits.jerk_m_s3;
  const double c = 8.0 * limits.a_max_m_s2 * distance_m;
  return 0.5 * (std::sqrt(b * b + c) - b);
}

}  // namespace gnbv
