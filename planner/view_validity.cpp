#include "planner/view_validity.hpp"

#include <algorithm>
#include <cmath>

namespace gnbv {
namespace {

/// Squared distance between a point and a segment.
double squared_distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double length2 = ab.squaredNorm();
  const double t = length2 > 0.0 ? std::clamp((p - a).dot(ab) / length2, 0.0, 1.0) : 0.0;
  return (p - (a + t * ab)).squaredNorm();
}

/// Squared distance between a segment and a box: convex along the segment, so a ternary search
/// finds its minimum (to 2^-24 of the segment's length after 42 thirds).
double squared_distance_to_segment(const Box3& box, const Vec3& a, const Vec3& b) {
  double lo = 0.0;
  double hi = 1.0;
  const auto at = [&](double t) { return box.squaredExteriorDistance(Vec3(a + t * (b - a))); };
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

bool is_recent(const ValidityConfig& config, std::span<const ViewPose> recent,
               const ViewPose& view) {
  return std::any_of(recent.begin(), recent.end(), [&](const ViewPose& pose) {
    return (pose.p_world_m - view.p_world_m).norm() < config.recent_distance_m &&
           std::fabs(wrap_angle_rad(pose.yaw_rad - view.yaw_rad)) < config.recent_yaw_rad;
  });
}

}  // namespace

std::string_view name_of(Rejection reason) {
  switch (reason) {
    case Rejection::out_of_bounds:
      return "out_of_bounds";
    case Rejection::not_free:
      return "not_free";
    case Rejection::collision:
      return "collision";
    case Rejection::path_blocked:
      return "path_blocked";
    case Rejection::recently_visited:
      return "recently_visited";
  }
  return "unknown";
}

Box3 navigation_box_m(const ValidityConfig& config, const Box3& workspace_m) {
  Box3 box = workspace_m;
  box.min().z() = std::max(box.min().z(), config.z_min_m);
  return box;
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
    const double nearest2 = squared_distance_to_segment(cube, from_world_m, to_world_m);
    // the search for the nearest point is good to rounding: the start itself is no approach
    constexpr double kRounding_m2 = 1e-9;
    return nearest2 < radius2 &&
           nearest2 < cube.squaredExteriorDistance(from_world_m) - kRounding_m2;
  });
}

std::optional<Rejection> rejection(const ValidityConfig& config, const Box3& navigation_m,
                                   const OccupancyGrid& grid, std::span<const ViewPose> recent,
                                   const ViewPose& current, const ViewPose& candidate) {
  // a lattice walked in steps ends on the box's faces but for rounding
  constexpr double kRounding_m = 1e-6;
  const Vec3& p = candidate.p_world_m;
  if (navigation_m.squaredExteriorDistance(p) > kRounding_m * kRounding_m) {
    return Rejection::out_of_bounds;
  }
  if (is_recent(config, recent, candidate)) return Rejection::recently_visited;
  if (grid.state_at(grid.geometry().nearest_inside(p)) != VoxelState::free) {
    return Rejection::not_free;
  }
  if (!is_sphere_clear(grid, p, config.collision_radius_m)) return Rejection::collision;
  if (!is_path_clear(grid, current.p_world_m, p, config.collision_radius_m)) {
    return Rejection::path_blocked;
  }
  return std::nullopt;
}

}  // namespace gnbv
