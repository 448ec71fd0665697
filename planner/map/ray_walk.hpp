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
  std::array<double, 3> to_upper_border_m = {0.0, 0.0, 0.0};
  std::array<double, 3> to_lower_border_m = {0.0, 0.0, 0.0};
};

inline RayOrigin make_ray_origin(const GridGeometry& grid, const Vec3f& origin_m) {
  RayOrigin origin;
  origin.p_m = origin_m;
  origin.key = grid.key_of(origin_m);
  // OctoMap rounds half a voxel to float32 before it adds it to the centre
  const auto half_m = static_cast<double>(static_cast<float>(grid.resolution_m() * 0.5));
  for (std::size_t a = 0; a < 3; ++a) {
    const auto p_m = static_cast<double>(origin_m[static_cast<Eigen::Index>(a)]);
    origin.to_upper_border_m[a] = (grid.center_m(origin.key[a]) + half_m) - p_m;
    origin.to_lower_border_m[a] = (grid.center_m(origin.key[a]) - half_m) - p_m;
  }
  return origin;
}

/// Steps of one ray: along axis a it crosses borders at t_next[a], then every t_voxel[a].
struct RaySteps {
  static constexpr double kNever = std::numeric_limits<double>::max();
  Key step = {0, 0, 0};
  std::array<double, 3> t_next{kNever, kNever, kNever};
  std::array<double, 3> t_voxel{kNever, kNever, kNever};
  double length_m = 0.0;  // 0 when float32 cannot tell the ends apart: such a ray takes no step
};

inline RaySteps make_ray_steps(const GridGeometry& grid, const RayOrigin& origin,
                               const Vec3f& end_m) {
  RaySteps ray;
  Vec3f direction = end_m - origin.p_m;
  // octomap::Vector3::norm sums float32 products, left to right, and takes a float64 root of it
  const float squared =
      direction[0] * direction[0] + direction[1] * direction[1] + direction[2] * direction[2];
  const float length_m = static_cast<float>(std::sqrt(static_cast<double>(squared)));
  if (!(length_m > 0.0F)) return ray;
  ray.length_m = static_cast<double>(length_m);
  for (std::size_t a = 0; a < 3; ++a) {
    const float d = direction[static_cast<Eigen::Index>(a)] / length_m;
    if (d == 0.0F) continue;
    const auto d64 = static_cast<double>(d);
    ray.step[a] = d > 0.0F ? 1 : -1;
    ray.t_next[a] = (d > 0.0F ? origin.to_upper_border_m[a] : origin.to_lower_border_m[a]) / d64;
    ray.t_voxel[a] = grid.resolution_m() / std::fabs(d64);
  }
  return ray;
}

/// The axis along which the ray next crosses a border; OctoMap's choice among equals.
inline std::size_t next_axis(const RaySteps& ray) {
  return ray.t_next[0] < ray.t_next[1] ? (ray.t_next[0] < ray.t_next[2] ? 0U : 2U)
                                       : (ray.t_next[1] < ray.t_next[2] ? 1U : 2U);
}

/// Visits the voxels from `origin` towards `end` in order, with the origin's and without the end's.
/// `visit(Key)` returns false to stop. Voxels outside the grid are visited too; the caller knows
/// its bounds. Both points must be finite.
template <typename Visit>
void walk_ray(const GridGeometry& grid, const RayOrigin& origin, const Vec3f& end_m,
              Visit&& visit) {
  Key key = origin.key;
  const Key key_end = grid.key_of(end_m);
  if (key == key_end || !visit(key)) return;
  RaySteps ray = make_ray_steps(grid, origin, end_m);
  if (!(ray.length_m > 0.0)) return;
  while (true) {
    const std::size_t axis = next_axis(ray);
    key[axis] += ray.step[axis];
    ray.t_next[axis] += ray.t_voxel[axis];
    if (key == key_end) return;
    // rounding may walk past the end voxel: stop at the ray's length
    if (std::min({ray.t_next[0], ray.t_next[1], ray.t_next[2]}) > ray.length_m) return;
    if (!visit(key)) return;
  }
}

/// walk_ray() by VoxelIndex, up to where the ray leaves the grid. `visit(VoxelIndex)` returns false
/// to stop.
template <typename Visit>
void walk_ray_inside(const GridGeometry& grid, const RayOrigin& origin, const Vec3f& end_m,
                     Visit&& visit) {
  walk_ray(grid, origin, end_m,
           [&](const Key& key) { return grid.contains(key) && visit(grid.index_of(key)); });
}

/// Whether `passes(Key)` holds for every voxel that walk_ray() visits between the points.
template <typename Passes>
bool all_along_ray(const GridGeometry& grid, const Vec3f& origin_m, const Vec3f& end_m,
                   const Passes& passes) {
  bool pass = true;
  walk_ray(grid, make_ray_origin(grid, origin_m), end_m,
           [&](const Key& key) { return pass = passes(key); });
  return pass;
}

template <typename Visit>
void walk_ray(const GridGeometry& grid, const Vec3f& origin_m, const Vec3f& end_m, Visit&& visit) {
  walk_ray(grid, make_ray_origin(grid, origin_m), end_m, visit);
}

}  // namespace gnbv
