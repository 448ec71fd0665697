#include "sim/rest_to_rest.hpp"

#include <algorithm>
#include <cmath>

#include "sim/core/error.hpp"

namespace gnbv {

RestToRest::RestToRest(double distance, double speed_max, double acceleration_max,
                       double smoothing_s)
    : distance_(distance), smoothing_s_(smoothing_s) {
  GNBV_CHECK(distance >= 0.0 && speed_max > 0.0 && acceleration_max > 0.0 && smoothing_s > 0.0,
             "distance {}, speed {}, acceleration {}, smoothing {} s", distance, speed_max,
             acceleration_max, smoothing_s);
  const double peak = std::min(speed_max, std::sqrt(acceleration_max * distance));
  const double ramp_s = peak / acceleration_max;
  const double cruise_s = peak > 0.0 ? std::max(0.0, distance / peak - ramp_s) : 0.0;
  trapezoid_s_ = 2.0 * ramp_s + cruise_s;

  phases_[0].acceleration = acceleration_max;
  const std::array<double, 3> starts_s = {ramp_s, ramp_s + cruise_s, trapezoid_s_};
  const std::array<double, 3> accelerations = {0.0, -acceleration_max, 0.0};
  for (std::size_t i = 0; i < 3; ++i) {
    const Trapezoid begin = along(phases_[i], starts_s[i]);
    phases_[i + 1] = {starts_s[i], begin.integral, begin.position, begin.speed, accelerations[i]};
  }
  phases_[3].position = distance;
  phases_[3].speed = 0.0;
}

RestToRest::Trapezoid RestToRest::along(const Phase& phase, double time_s) {
  const double t = time_s - phase.start_s;
  const double half_a = 0.5 * phase.acceleration;
  return {phase.integral + t * (phase.position + t * (0.5 * phase.speed + t * half_a / 3.0)),
          phase.position + t * (phase.speed + t * half_a), phase.speed + t * phase.acceleration};
}

RestToRest::Trapezoid RestToRest::trapezoid(double time_s) const {
  if (time_s <= 0.0) return {};
  std::size_t i = 3;
  while (i > 0 && time_s < phases_[i].start_s) --i;
  return along(phases_[i], time_s);
}

RestToRest::Sample RestToRest::at(double time_s) const {
  if (time_s >= duration_s()) return {distance_, 0.0, 0.0};
  const Trapezoid now = trapezoid(time_s);
  const Trapezoid before = trapezoid(time_s - smoothing_s_);
  return {(now.integral - before.integral) / smoothing_s_,
          (now.position - before.position) / smoothing_s_,
          (now.speed - before.speed) / smoothing_s_};
}

}  // namespace gnbv
