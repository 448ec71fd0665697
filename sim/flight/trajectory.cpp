#include "sim/flight/trajectory.hpp"

#include <algorithm>
#include <cmath>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

void move(Motion& now, double jerk, double dt_s) {
  now.position += dt_s * (now.speed + dt_s * (now.acceleration / 2.0 + dt_s * jerk / 6.0));
  now.speed += dt_s * (now.acceleration + dt_s * jerk / 2.0);
  now.acceleration += dt_s * jerk;
}

/// The speed at half way when nothing is lost on cruising: with a stretch of constant acceleration
/// if there is room for one, otherwise the jerk alone shapes the motion.
double peak_speed_within(double distance, double acceleration, double jerk) {
  const double lost_to_jerk = acceleration * acceleration / jerk;
  const bool has_room = distance >= 2.0 * lost_to_jerk * acceleration / jerk;
  if (!has_room) return std::cbrt(0.25 * distance * distance * jerk);
  return 0.5 *
         (std::sqrt(lost_to_jerk * lost_to_jerk + 4.0 * acceleration * distance) - lost_to_jerk);
}

}  // namespace

SpeedChange speed_change(const Motion& now, double speed, const AxisLimits& limits,
                         std::optional<double> duration_s) {
  const double dv = speed - now.speed;
  const double a0 = now.acceleration;
  // towards the wanted speed, from the one that is reached by braking the acceleration at once
  const double jerk = dv >= a0 * std::abs(a0) / (2.0 * limits.jerk) ? limits.jerk : -limits.jerk;
  // the fastest: without a middle phase a1^2 / j - a0^2 / (2 j) = dv, PX4's T1 = (a1 - a0) / j
  double peak = std::copysign(std::sqrt(std::max(0.0, jerk * dv + 0.5 * a0 * a0)), jerk);
  if (duration_s) {
    // T1 + T2 + T3 = T gives a1^2 - a1 (j T + a0) + j dv + a0^2 / 2 = 0; the root nearer to zero
    const double sum = jerk * *duration_s + a0;
    const double squared = sum * sum - 4.0 * jerk * dv - 2.0 * a0 * a0;
    if (!(squared < 0.0)) peak = 0.5 * (sum - std::copysign(std::sqrt(squared), jerk));
  }
  const double a1 = std::clamp(peak, -limits.acceleration, limits.acceleration);
  SpeedChange change{.jerk = jerk, .t1_s = std::max(0.0, (a1 - a0) / jerk)};
  const double reached = a0 + jerk * change.t1_s;
  change.t3_s = std::max(0.0, reached / jerk);
  // the middle phase fills up what is missing of the speed
  const double dv_outer = 0.5 * (a0 + reached) * change.t1_s + 0.5 * reached * change.t3_s;
  if (std::abs(reached) > 1e-9) change.t2_s = std::max(0.0, (dv - dv_outer) / reached);
  return change;
}

Motion advance(const Motion& now, const SpeedChange& change, double dt_s) {
  Motion after = now;
  const double t1 = std::min(dt_s, change.t1_s);
  const double t2 = std::min(dt_s - t1, change.t2_s);
  const double t3 = std::min(dt_s - t1 - t2, change.t3_s);
  move(after, change.jerk, t1);
  move(after, 0.0, t2);
  move(after, -change.jerk, t3);
  if (dt_s >= change.duration_s()) after.acceleration = 0.0;
  move(after, 0.0, dt_s - t1 - t2 - t3);
  return after;
}

std::array<Motion, 3> advance_together(const std::array<Motion, 3>& axes,
                                       const std::array<double, 3>& speeds,
                                       const std::array<AxisLimits, 3>& limits, double dt_s) {
  double longest_s = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    longest_s = std::max(longest_s, speed_change(axes[i], speeds[i], limits[i]).duration_s());
  }
  std::array<Motion, 3> after;
  for (std::size_t i = 0; i < 3; ++i) {
    after[i] = advance(axes[i], speed_change(axes[i], speeds[i], limits[i], longest_s), dt_s);
  }
  return after;
}

double braking_speed(double distance, const AxisLimits& limits, double end_speed) {
  const double b = 4.0 * limits.acceleration * limits.acceleration / limits.jerk;
  const double c = 8.0 * limits.acceleration * distance + 4.0 * end_speed * end_speed;
  return std::max(end_speed, 0.5 * (std::sqrt(b * b + c) - b));
}

RestToRest::RestToRest(double distance, const Limits& limits)
    : distance_(distance), jerk_(limits.jerk) {
  GNBV_CHECK(
      distance >= 0.0 && limits.speed > 0.0 && limits.acceleration > 0.0 && limits.jerk > 0.0,
      "distance {}, speed {}, acceleration {}, jerk {}", distance, limits.speed,
      limits.acceleration, limits.jerk);
  if (distance == 0.0) return;
  const double peak_speed =
      std::min(limits.speed, peak_speed_within(distance, limits.acceleration, limits.jerk));
  jerk_s_ = std::min(limits.acceleration / limits.jerk, std::sqrt(peak_speed / limits.jerk));
  speeding_up_s_ = peak_speed / (limits.jerk * jerk_s_) + jerk_s_;
  // speeding up and slowing down cover peak_speed * speeding_up_s together
  cruise_s_ = std::max(0.0, distance / peak_speed - speeding_up_s_);
}

Motion RestToRest::first_half(double time_s) const {
  const double grown_s = std::min(time_s, jerk_s_);
  Motion now = {jerk_ * grown_s * grown_s * grown_s / 6.0, 0.5 * jerk_ * grown_s * grown_s,
                jerk_ * grown_s};
  const double fades_at_s = speeding_up_s_ - jerk_s_;
  if (time_s > jerk_s_) move(now, 0.0, std::min(time_s - jerk_s_, speeding_up_s_ - 2.0 * jerk_s_));
  if (time_s > fades_at_s) move(now, -jerk_, std::min(time_s - fades_at_s, jerk_s_));
  if (time_s > speeding_up_s_) {
    now.acceleration = 0.0;
    move(now, 0.0, time_s - speeding_up_s_);
  }
  return now;
}

Motion RestToRest::at(double time_s) const {
  if (time_s <= 0.0) return {0.0, 0.0, 0.0};
  if (time_s >= duration_s()) return {distance_, 0.0, 0.0};
  if (time_s <= 0.5 * duration_s()) return first_half(time_s);
  const Motion mirrored = first_half(duration_s() - time_s);  // the motion is symmetric in time
  return {distance_ - mirrored.position, mirrored.speed, -mirrored.acceleration};
}

}  // namespace gnbv
