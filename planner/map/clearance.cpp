#include "planner/map/clearance.hpp"

#include <algorithm>
#include <cmath>

#include "planner/map/ray_walk.hpp"
#include "sim/core/error.hpp"

namespace gnbv {
namespace {

/// Squared distance between a point and a segment.
double squared_distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double length2 = ab.squaredNorm();
  const double t = length2 > 0.0 ? std::clamp((p - a).dot(ab) / length2, 0.0, 1.0) : 0.0;
  return (p - (a + t * ab)).squaredNorm();
}

/// Keys from low to high, both included, that the grid has of those within `margin_m` of the box.
struct KeyRange {
  Key low, high;
  bool is_empty() const { return low[0] > high[0] || low[1] > high[1] || low[2] > high[2]; }
};

KeyRange keys_near(const GridGeometry& geometry, const Box3& box, double margin_m) {
  KeyRange keys;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto axis = static_cast<Eigen::Index>(a);
    keys.low[a] = std::max(geometry.key_of(box.min()[axis] - margin_m), geometry.min_key()[a]);
    keys.high[a] = std::min(geometry.key_of(box.max()[axis] + margin_m),
                            geometry.min_key()[a] + geometry.size()[a] - 1);
  }
  return keys;
}

/// Whether `is_hit` says so of the cube of any occupied voxel of the row that begins at `key`.
template <typename IsHit>
bool any_occupied_in_row(const OccupancyGrid& grid, Key key, std::int32_t last_x,
                         const IsHit& is_hit) {
  const GridGeometry& geometry = grid.geometry();
  const Vec3 half_m = Vec3::Constant(0.5 * geometry.resolution_m());
  for (VoxelIndex v = geometry.index_of(key); key[0] <= last_x; ++key[0], ++v) {
    if (grid.state(v) != VoxelState::occupied) continue;
    const Vec3 center_m = geometry.center_m(key);
    if (is_hit(Box3(center_m - half_m, center_m + half_m))) return true;
  }
  return false;
}

/// Part of a segment, as shares of it; empty when `first` is above `last`.
struct Share {
  double first = 0.0, last = 1.0;
};

/// Where a + t (b - a) lies within `reach` of `center`.
Share share_near(double a, double b, double center, double reach) {
  if (a == b) return std::fabs(a - center) <= reach ? Share{} : Share{1.0, 0.0};
  const double one = (center - reach - a) / (b - a);
  const double other = (center + reach - a) / (b - a);
  return {std::max(std::min(one, other), 0.0), std::min(std::max(one, other), 1.0)};
}

Share both(const Share& a, const Share& b) {
  return {std::max(a.first, b.first), std::min(a.last, b.last)};
}

/// The same of the voxels within `margin_m` of the segment's box whose centres lie within `reach_m`
/// of the segment; of some others there, too. Rows are cut to where the segment passes by.
template <typename IsHit>
bool any_occupied_along(const OccupancyGrid& grid, const Vec3& a_m, const Vec3& b_m,
                        double margin_m, double reach_m, const IsHit& is_hit) {
  const GridGeometry& geometry = grid.geometry();
  const double wide_m = reach_m + 1e-3 * geometry.resolution_m();  // more than anything here rounds
  Box3 span_m(a_m);
  span_m.extend(b_m);
  const KeyRange keys = keys_near(geometry, span_m, margin_m);
  if (keys.is_empty()) return false;
  Key key;
  for (key[2] = keys.low[2]; key[2] <= keys.high[2]; ++key[2]) {
    const Share in_layer = share_near(a_m.z(), b_m.z(), geometry.center_m(key[2]), wide_m);
    if (in_layer.first > in_layer.last) continue;
    for (key[1] = keys.low[1]; key[1] <= keys.high[1]; ++key[1]) {
      const Share share =
          both(in_layer, share_near(a_m.y(), b_m.y(), geometry.center_m(key[1]), wide_m));
      if (share.first > share.last) continue;
      const double one_m = a_m.x() + share.first * (b_m.x() - a_m.x());
      const double other_m = a_m.x() + share.last * (b_m.x() - a_m.x());
      const auto [low_m, high_m] = std::minmax(one_m, other_m);
      key[0] = std::max(geometry.key_of(low_m - wide_m), keys.low[0]);
      const std::int32_t last_x = std::min(geometry.key_of(high_m + wide_m), keys.high[0]);
      if (key[0] <= last_x && any_occupied_in_row(grid, key, last_x, is_hit)) return true;
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
  const auto is_hit = [&](const Box3& cube) {
    return cube.squaredExteriorDistance(p_world_m) < radius_m * radius_m;
  };
  const KeyRange keys = keys_near(grid.geometry(), Box3(p_world_m), radius_m);
  if (keys.is_empty()) return true;
  Key key = keys.low;
  for (; key[2] <= keys.high[2]; ++key[2]) {
    for (key[1] = keys.low[1]; key[1] <= keys.high[1]; ++key[1]) {
      if (any_occupied_in_row(grid, key, keys.high[0], is_hit)) return false;
    }
  }
  return true;
}

bool is_path_clear(const OccupancyGrid& grid, const Vec3& from_world_m, const Vec3& to_world_m,
                   double radius_m) {
  GNBV_CHECK(from_world_m.allFinite() && to_world_m.allFinite(), "a path to {} {} {}",
             to_world_m.x(), to_world_m.y(), to_world_m.z());
  const double radius2 = radius_m * radius_m;
  // of a cube that comes within the radius the centre lies within that
  const double reach_m = radius_m + 0.5 * std::sqrt(3.0) * grid.geometry().resolution_m();
  const auto is_hit = [&](const Box3& cube) {
    const double to_center2 = squared_distance_to_segment(cube.center(), from_world_m, to_world_m);
    if (to_center2 > reach_m * reach_m) return false;
    const double nearest2 = box_to_segment_m2(cube, from_world_m, to_world_m);
    // the search for the nearest point is good to rounding: the start itself is no approach
    constexpr double kRounding_m2 = 1e-9;
    return nearest2 < radius2 &&
           nearest2 < cube.squaredExteriorDistance(from_world_m) - kRounding_m2;
  };
  return !any_occupied_along(grid, from_world_m, to_world_m, radius_m, reach_m, is_hit);
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
