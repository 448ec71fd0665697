// How much of a plane lies in a cube.
#pragma once

#include <algorithm>
#include <cmath>

#include "sim/core/pose.hpp"

namespace gnbv {

/// Area of the section of a cube by a plane of the unit normal at a distance from the cube's
/// centre. Of the unit cube it is the second difference of a truncated square along each axis of
/// the normal: sum over the corners s of (-1)^|s| max(0, t - s n)^2 / (2 n_x n_y n_z), where t is
/// the plane's distance from the lowest corner. Within a percent where a component of the normal
/// is below 0.01.
inline double plane_section_area(const Vec3& normal, double distance, double edge) {
  constexpr double kLeast = 0.01;
  const Vec3 n = normal.cwiseAbs().cwiseMax(kLeast);
  const double t = 0.5 * n.sum() - std::fabs(distance) / edge;
  if (t <= 0.0) return 0.0;
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    double along = t;
    double sign = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      if (((corner >> axis) & 1) == 0) continue;
      along -= n[axis];
      sign = -sign;
    }
    if (along > 0.0) sum += sign * along * along;
  }
  return edge * edge * std::max(0.0, sum / (2.0 * n.prod()));
}

}  // namespace gnbv
