// How long a body takes from rest to rest, with limits on speed and acceleration alone.
#pragma once

#include <cmath>

namespace gnbv {

/// Seconds for a distance of 0 or more, in m or rad, with limits above 0 in the same unit: a
/// trapezoid of speed, or a triangle where it is too short for that.
inline double rest_to_rest_s(double distance, double speed, double acceleration) {
  const double ramps = speed * speed / acceleration;
  return distance < ramps ? 2.0 * std::sqrt(distance / acceleration)
                          : distance / speed + speed / acceleration;
}

}  // namespace gnbv
