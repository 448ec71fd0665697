// How a body moves through the world, in closed form.
#pragma once

#include <cmath>
#include <vector>

#include "sim/core/pose.hpp"

namespace gnbv {

/// From where the body stands straight to each of the offsets, at one speed, without turning. Then
/// it stands there, or, `loop`, comes straight back to where it stood and goes around again.
struct BodyMotion {
  std::vector<Vec3> offsets_m;  // from where it stands; none: it does not move
  double speed_m_s = 1.0;
  bool loop = true;
  bool known = false;  // to those who fly

  /// The corners of one round, its first and last one included.
  std::vector<Vec3> corners_m() const {
    std::vector<Vec3> corners = {Vec3::Zero()};
    corners.insert(corners.end(), offsets_m.begin(), offsets_m.end());
    if (loop) corners.emplace_back(Vec3::Zero());
    return corners;
  }
  /// Of one round.
  double length_m() const {
    const std::vector<Vec3> corners = corners_m();
    double sum_m = 0.0;
    for (std::size_t i = 1; i < corners.size(); ++i) sum_m += (corners[i] - corners[i - 1]).norm();
    return sum_m;
  }
  /// After so many metres of the way.
  Vec3 offset_after(double along_m) const {
    const double round_m = length_m();
    if (round_m == 0.0) return Vec3::Zero();
    if (loop) along_m = std::fmod(along_m, round_m);
    const std::vector<Vec3> corners = corners_m();
    for (std::size_t i = 1; i < corners.size(); ++i) {
      const Vec3 edge_m = corners[i] - corners[i - 1];
      const double edge = edge_m.norm();
      if (along_m < edge) return corners[i - 1] + along_m / edge * edge_m;
      along_m -= edge;
    }
    return corners.back();
  }
  Vec3 offset_at(double time_s) const { return offset_after(speed_m_s * time_s); }
};

}  // namespace gnbv
