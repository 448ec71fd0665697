#include "sim/flight/rest_to_rest.hpp"

#include <algorithm>
#include <cmath>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

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

RestToRest::Sample RestToRest::first_half(double time_s) const {
  const double acceleration = jerk_ * jerk_s_;
  const double grown_s = std::min(time_s, jerk_s_);
  Sample now = {jerk_ * grown_s * grown_s * grown_s / 6.0, 0.5 * jerk_ * grown_s * grown_s,
                jerk_ * grown_s};
  const auto advance = [&now](double dt_s, double jerk) {
    now.position += dt_s * (now.speed + dt_s * (now.acceleration / 2.0 + dt_s * jerk / 6.0));
    now.speed += dt_s * (now.acceleration + dt_s * jerk / 2.0);
    now.acceleration += dt_s * jerk;
  };
  const double constant_s = speeding_up_s_ - 2.0 * jerk_s_;
  if (time_s > jerk_s_) advance(std::min(time_s - jerk_s_, constant_s), 0.0);
  if (time_s > speeding_up_s_ - jerk_s_) {
    now.acceleration = acceleration;
    advance(std::min(time_s - (speeding_up_s_ - jerk_s_), jerk_s_), -jerk_);
  }
  if (time_s > speeding_up_s_) {
    now.acceleration = 0.0;
    now.position += (time_s - speeding_up_s_) * now.speed;
  }
  return now;
}

RestToRest::Sample RestToRest::at(double time_s) const {
  if (time_s <= 0.0) return {0.0, 0.0, 0.0};
  if (time_s >= duration_s()) return {distance_, 0.0, 0.0};
  if (time_s <= 0.5 * duration_s()) return first_half(time_s);
  const Sample mirrored = first_half(duration_s() - time_s);  // the motion is symmetric in time
  return {distance_ - mirrored.position, mirrored.speed, -mirrored.acceleration};
}

}  // namespace gnbv
