// One ray through the lattice, exactly as OctoMap walks it: same float32 direction, same float64
// steps, so the same voxels bit for bit as octomap::OcTreeBaseImpl::computeRayKeys (1.9.7;
// Amanatides and Woo 1987).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/map/grid_geometry.hpp"

namespace gnbv {

/// What all rays from one point share.
struct RayOrigin {
  Vec3f p_m = Vec3f::Zero();
  Key key = {0, 0, 0};
  // signed distance from the point to the borders of its voxel, along each axis
  std::array<double, 3> to_upper_border_m = {}, to_lower_border_m = {};
};

inline RayOrigin make_ray_origin(const GridGeometry& grid, const Vec3f& origin_m) {
  RayOrigin origin = {.p_m = origin_m, .key = grid.key_of(origin_m)};
  // OctoMap rounds half a voxel to float32 before it adds it to the centre
  const double half_m = static_cast<float>(grid.resolution_m() * 0.5);
  for (int a = 0; a < 3; ++a) {
    origin.to_upper_border_m[a] = (grid.center_m(origin.key[a]) + half_m) - origin_m[a];
    origin.to_lower_border_m[a] = (grid.center_m(origin.key[a]) - half_m) - origin_m[a];
  }
  return origin;
}

/// A ray on its way from voxel to voxel: along axis a it crosses borders at t_next[a], then every
/// t_voxel[a].
struct RaySteps {
  static constexpr double kNever = std::numeric_limits<double>::max();
  Key key = {0, 0, 0};  // where it is
  Key key_end = {0, 0, 0};
  Key step = {0, 0, 0};
  std::array<double, 3> t_next{kNever, kNever, kNever};
  std::array<double, 3> t_voxel{kNever, kNever, kNever};
  double length_m = 0.0;  // 0 when float32 cannot tell the ends apart: such a ray takes no step

  /// Goes on to the next voxel; false when the ray ends before it, or there.
  bool advance() {
    // OctoMap's choice among equals; without a branch, which would be guessed wrong
    const bool is_x_first = t_next[0] < t_next[1];
    const bool is_x = is_x_first & (t_next[0] < t_next[2]);
    const bool is_y = !is_x_first & (t_next[1] < t_next[2]);
    const std::array<bool, 3> is_next = {is_x, is_y, !(is_x | is_y)};
    for (std::size_t a = 0; a < 3; ++a) {
      key[a] += is_next[a] ? step[a] : 0;
      t_next[a] += is_next[a] ? t_voxel[a] : 0.0;
    }
    // rounding may walk past the end voxel: stop at the ray's length
    return key != key_end && !(std::min({t_next[0], t_next[1], t_next[2]}) > length_m);
  }
};

inline RaySteps make_ray_steps(const GridGeometry& grid, const RayOrigin& origin,
                               const Vec3f& end_m) {
  RaySteps ray = {.key = origin.key, .key_end = grid.key_of(end_m)};
  const Vec3f direction = end_m - origin.p_m;
  // octomap::Vector3::norm sums float32 products, left to right, and takes a float64 root of it
  const float squared =
      direction[0] * direction[0] + direction[1] * direction[1] + direction[2] * direction[2];
  const auto length_m = static_cast<float>(std::sqrt(static_cast<double>(squared)));
  if (!(length_m > 0.0F)) return ray;
  ray.length_m = length_m;
  for (int a = 0; a < 3; ++a) {
    const double d = direction[a] / length_m;  // rounded to float32
    if (d == 0.0) continue;
    ray.step[a] = d > 0.0 ? 1 : -1;
    ray.t_next[a] = (d > 0.0 ? origin.to_upper_border_m[a] : origin.to_lower_border_m[a]) / d;
    ray.t_voxel[a] = grid.resolution_m() / std::fabs(d);
  }
  return ray;
}

/// Visits the voxels from `origin` towards `end` in order, with the origin's and without the end's.
/// `visit(Key)` returns false to stop. Voxels outside the grid are visited too; the caller knows
/// its bounds. Both points must be finite.
template <typename Visit>
void walk_ray(const GridGeometry& grid, const RayOrigin& origin, const Vec3f& end_m,
              const Visit& visit) {
  RaySteps ray = make_ray_steps(grid, origin, end_m);
  if (ray.key == ray.key_end || !visit(ray.key) || !(ray.length_m > 0.0)) return;
  while (ray.advance() && visit(ray.key)) {
  }
}
template <typename Visit>
void walk_ray(const GridGeometry& grid, const Vec3f& origin_m, const Vec3f& end_m,
              const Visit& visit) {
  walk_ray(grid, make_ray_origin(grid, origin_m), end_m, visit);
}

/// walk_ray() by VoxelIndex, up to where the ray leaves the grid. `visit(VoxelIndex)` returns false
/// to stop.
template <typename Visit>
void walk_ray_inside(const GridGeometry& grid, const RayOrigin& origin, const Vec3f& end_m,
                     const Visit& visit) {
  walk_ray(grid, origin, end_m,
           [&](const Key& key) { return grid.contains(key) && visit(grid.index_of(key)); });
}

/// Whether `passes(Key)` holds for every voxel that walk_ray() visits between the points.
template <typename Passes>
bool all_along_ray(const GridGeometry& grid, const Vec3f& origin_m, const Vec3f& end_m,
                   const Passes& passes) {
  bool pass = true;
  walk_ray(grid, origin_m, end_m, [&](const Key& key) { return pass = passes(key); });
  return pass;
}

}  // namespace gnbv
