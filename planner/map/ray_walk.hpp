// One ray through the lattice, exactly as OctoMap walks it.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/map/grid_geometry.hpp"

namespace gnbv {

/// Visits the voxels from `origin` towards `end` in order, with the origin's and without the end's,
/// as octomap::OcTreeBaseImpl::computeRayKeys (1.9.7; Amanatides and Woo 1987) does: same float32
/// direction, same float64 steps, so the same voxels bit for bit. `visit(Key)` returns false to
/// stop. Voxels outside the grid are visited too; the caller knows its bounds.
template <typename Visit>
void walk_ray(const GridGeometry& grid, const Vec3f& origin_m, const Vec3f& end_m, Visit&& visit) {
  Key key;
  Key key_end;
  for (std::size_t a = 0; a < 3; ++a) {
    key[a] = grid.key_of(static_cast<double>(origin_m[static_cast<int>(a)]));
    key_end[a] = grid.key_of(static_cast<double>(end_m[static_cast<int>(a)]));
  }
  if (key == key_end || !visit(key)) return;

  Vec3f direction = end_m - origin_m;
  // octomap::Vector3::norm sums float32 products, left to right, and takes a float64 root of it
  const float squared =
      direction[0] * direction[0] + direction[1] * direction[1] + direction[2] * direction[2];
  const float length_m = static_cast<float>(std::sqrt(static_cast<double>(squared)));
  direction[0] /= length_m;
  direction[1] /= length_m;
  direction[2] /= length_m;

  constexpr double kNever = std::numeric_limits<double>::max();
  const double resolution_m = grid.resolution_m();
  Key step = {0, 0, 0};
  std::array<double, 3> t_next{kNever, kNever, kNever};
  std::array<double, 3> t_voxel{kNever, kNever, kNever};
  for (std::size_t a = 0; a < 3; ++a) {
    const float d = direction[static_cast<int>(a)];
    step[a] = d > 0.0F ? 1 : (d < 0.0F ? -1 : 0);
    if (step[a] == 0) continue;
    double border_m = grid.center_m(key[a]);
    border_m += static_cast<double>(static_cast<float>(step[a] * resolution_m * 0.5));
    const auto d64 = static_cast<double>(d);
    t_next[a] = (border_m - static_cast<double>(origin_m[static_cast<int>(a)])) / d64;
    t_voxel[a] = resolution_m / std::fabs(d64);
  }

  while (true) {
    const std::size_t axis = t_next[0] < t_next[1] ? (t_next[0] < t_next[2] ? 0U : 2U)
                                                   : (t_next[1] < t_next[2] ? 1U : 2U);
    key[axis] += step[axis];
    t_next[axis] += t_voxel[axis];
    if (key == key_end) return;
    // rounding may walk past the end voxel: stop at the ray's length
    if (std::min({t_next[0], t_next[1], t_next[2]}) > static_cast<double>(length_m)) return;
    if (!visit(key)) return;
  }
}

}  // namespace gnbv
