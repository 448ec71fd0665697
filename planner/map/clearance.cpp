#include "planner/map/clearance.hpp"

#include <algorithm>
#include <cmath>

#include "planner/map/ray_walk.hpp"

namespace gnbv {
namespace {

/// Squared distance between a point and a segment.
double squared_distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double length2 = ab.squaredNorm();
  const double t = length2 > 0.0 ? std::clamp((p - a).dot(ab) / length2, 0.0, 1.0) : 0.0;
  return (p - (a + t * ab)).squaredNorm();
}

/// Whether `is_hit` says so of the cube of any occupied voxel within `margin_m` of the box.
template <typename IsHit>
bool any_occupied_near(const OccupancyGrid& grid, const Box3& box, double margin_m,
                       const IsHit& is_hit) {
  const GridGeometry& geometry = grid.geometry();
  Key lo;
  Key hi;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto axis = static_cast<Eigen::Index>(a);
    lo[a] = std::max(geometry.key_of(box.min()[axis] - margin_m), geometry.min_key()[a]);
    hi[a] = std::min(geometry.key_of(box.max()[axis] + margin_m),
                     geometry.min_key()[a] + geometry.size()[a] - 1);
    if (lo[a] > hi[a]) return false;
  }
  const Vec3 half_m = Vec3::Constant(0.5 * geometry.resolution_m());
  for (Key key = lo; key[2] <= hi[2]; ++key[2]) {
    for (key[1] = lo[1]; key[1] <= hi[1]; ++key[1]) {
      key[0] = lo[0];
      for (VoxelIndex v = geometry.index_of(key); key[0] <= hi[0]; ++key[0], ++v) {
        if (grid.state(v) != VoxelState::occupied) continue;
        const Vec3 center_m = geometry.center_m(key);
        if (is_hit(Box3(center_m - half_m, center_m + half_m))) return true;
      }
    }
  }
  return false;
}

}  // namespace

// Convex along the segment, so a ternary search finds the minimum.
double box_to_segment_m2(const Box3& box_m, const Vec3& a_m, const Vec3& b_m) {
  double lo = 0.0;
  double hi = 1.0;
  const auto at = [&](double t) {
    return box_m.squaredExteriorDistance(Vec3(a_m + t * (b_m - a_m)));
  };
  for (int i = 0; i < 42; ++i) {
    const double third = (hi - lo) / 3.0;
    if (at(lo + third) <= at(hi - third)) {
      hi -= third;
    } else {
      lo += third;
    }
  }
  return at(0.5 * (lo + hi));
}

bool is_sphere_clear(const OccupancyGrid& grid, const Vec3& p_world_m, double radius_m) {
  return !any_occupied_near(grid, Box3(p_world_m), radius_m, [&](const Box3& cube) {
    return cube.squaredExteriorDistance(p_world_m) < radius_m * radius_m;
  });
}

bool is_path_clear(const OccupancyGrid& grid, const Vec3& from_world_m, const Vec3& to_world_m,
                   double radius_m) {
  Box3 span(from_world_m);
  span.extend(to_world_m);
  const double radius2 = radius_m * radius_m;
  const double reach_m = radius_m + 0.5 * std::sqrt(3.0) * grid.geometry().resolution_m();
  return !any_occupied_near(grid, span, radius_m, [&](const Box3& cube) {
    const double to_center2 = squared_distance_to_segment(cube.center(), from_world_m, to_world_m);
    if (to_center2 > reach_m * reach_m) return false;
    const double nearest2 = box_to_segment_m2(cube, from_world_m, to_world_m);
    // the search for the nearest point is good to rounding: the start itself is no approach
    constexpr double kRounding_m2 = 1e-9;
    return nearest2 < radius2 &&
           nearest2 < cube.squaredExteriorDistance(from_world_m) - kRounding_m2;
  });
}

bool is_line_free(const OccupancyGrid& grid, const Vec3& from_world_m, const Vec3& to_world_m) {
  const GridGeometry& geometry = grid.geometry();
  const Vec3 to_m = geometry.nearest_inside(to_world_m);
  bool is_free = grid.state_at(to_m) == VoxelState::free;
  if (!is_free) return false;
  walk_ray(geometry, geometry.nearest_inside(from_world_m).cast<float>(), to_m.cast<float>(),
           [&](const Key& key) {
             is_free =
                 geometry.contains(key) && grid.state(geometry.index_of(key)) == VoxelState::free;
             return is_free;
           });
  return is_free;
}

}  // namespace gnbv
