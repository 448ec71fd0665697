// How long a body takes from rest to rest, with limits on speed and acceleration alone.
#pragma once

#include <cmath>

namespace gnbv {

/// Metres or radians, and the limits in the same unit.
inline double rest_to_rest_s(double distance, double speed, double acceleration) {
  const double ramps = speed * speed / acceleration;
  return distance < ramps ? 2.0 * std::sqrt(distance / acceleration)
                          : distance / speed + speed / acceleration;
}

}  // namespace gnbv
