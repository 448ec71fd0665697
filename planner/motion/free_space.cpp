#include "planner/motion/free_space.hpp"

#include <algorithm>
#include <cmath>

#include "planner/map/ray_walk.hpp"
#include "sim/core/error.hpp"

namespace gnbv {
namespace {

/// Part of a segment from a to b, as shares of it.
struct Share {
  double first = 0.0, last = 1.0;
  bool is_empty() const { return first > last; }
};

/// What of the share lies within `reach` of `center` along one axis: there a + t (b - a) is between
/// center - reach and center + reach.
Share cut(const Share& share, double a, double b, double center, double reach) {
  if (a == b) return std::fabs(a - center) <= reach ? share : Share{1.0, 0.0};
  const auto [low, high] =
      std::minmax({(center - reach - a) / (b - a), (center + reach - a) / (b - a)});
  return {std::max(low, share.first), std::min(high, share.last)};
}

/// Whether `is_hit` holds for the cube of any occupied voxel that comes within the radius of the
/// segment; it is asked of some others nearby, too. Goes through the rows of voxels along x in the
/// segment's box grown by the radius. Each row is cut to where the segment passes by: the centre of
/// a cube within the radius is no farther off than the radius and half the cube's diagonal.
template <typename IsHit>
bool any_occupied_near(const OccupancyGrid& grid, const Vec3& a_m, const Vec3& b_m, double radius_m,
                       const IsHit& is_hit) {
  const GridGeometry& geometry = grid.geometry();
  const double voxel_m = geometry.resolution_m();
  const Vec3 half_m = Vec3::Constant(0.5 * voxel_m);
  const double wide_m =
      radius_m + half_m.norm() + 1e-3 * voxel_m;  // more than anything here rounds
  const Vec3 reach_m = Vec3::Constant(radius_m);
  const KeyBox keys =
      geometry.keys_in(Box3(a_m.cwiseMin(b_m) - reach_m, a_m.cwiseMax(b_m) + reach_m));
  for (Key key = keys.low; key[2] <= keys.high[2]; ++key[2]) {
    const Share layer = cut({}, a_m.z(), b_m.z(), geometry.center_m(key[2]), wide_m);
    if (layer.is_empty()) continue;
    for (key[1] = keys.low[1]; key[1] <= keys.high[1]; ++key[1]) {
      const Share row = cut(layer, a_m.y(), b_m.y(), geometry.center_m(key[1]), wide_m);
      if (row.is_empty()) continue;
      const auto [first_m, last_m] = std::minmax(
          {a_m.x() + row.first * (b_m.x() - a_m.x()), a_m.x() + row.last * (b_m.x() - a_m.x())});
      key[0] = std::max(geometry.key_of(first_m - wide_m), keys.low[0]);
      const std::int32_t last_x = std::min(geometry.key_of(last_m + wide_m), keys.high[0]);
      if (key[0] > last_x) continue;
      for (VoxelIndex v = geometry.index_of(key); key[0] <= last_x; ++key[0], ++v) {
        if (grid.state(v) != VoxelState::occupied) continue;
        const Vec3 center_m = geometry.center_m(key);
        if (is_hit(Box3(center_m - half_m, center_m + half_m))) return true;
      }
    }
  }
  return false;
}

/// Whether the leg comes nearer to the box than `radius_m`, and nearer than it is at its start:
/// what is too near already may be left but not approached.
bool is_approached(const Box3& box_m, const Vec3& from_m, const Vec3& to_m, double radius_m) {
  // the nearest distance is found up to rounding: the start itself is no approach
  constexpr double kRounding_m2 = 1e-9;
  const double nearest_m2 = box_to_segment_m2(box_m, from_m, to_m);
  return nearest_m2 < radius_m * radius_m &&
         nearest_m2 < box_m.squaredExteriorDistance(from_m) - kRounding_m2;
}

/// From the point to the nearest occupied cube, at most `most_m`.
double clearance_m(const OccupancyGrid& grid, const Vec3& p_m, double most_m) {
  double nearest_m2 = most_m * most_m;
  any_occupied_near(grid, p_m, p_m, most_m, [&](const Box3& cube) {
    nearest_m2 = std::min(nearest_m2, cube.squaredExteriorDistance(p_m));
    return false;
  });
  return std::sqrt(nearest_m2);
}

/// The rule of is_line_free(), asked about voxels in their order along the line.
class FreeFromVehicle {
 public:
  FreeFromVehicle(const OccupancyGrid& grid, const Vec3& own_world_m, double radius_m)
      : grid_(grid),
        own_m_(grid.geometry().nearest_inside(own_world_m)),
        own_(grid.geometry().key_of(Vec3f(own_m_.cast<float>()))),  // as a ray's
        radius_m_(radius_m) {}

  bool is_free(const Key& key) {
    const GridGeometry& geometry = grid_.geometry();
    if (!geometry.contains(key)) return false;
    const VoxelState state = grid_.state(geometry.index_of(key));
    if (state == VoxelState::free) is_blind_ = false;
    if (state == VoxelState::free || key == own_) return true;
    return state == VoxelState::unknown && is_blind_ &&
           (geometry.center_m(key) - own_m_).squaredNorm() <= radius_m_ * radius_m_;
  }

 private:
  const OccupancyGrid& grid_;
  const Vec3 own_m_;
  const Key own_;
  const double radius_m_;
  bool is_blind_ = true;  // no voxel was seen yet
};

}  // namespace

bool NoFly::allows(const Vec3& p_world_m) const {
  return std::none_of(boxes_m.begin(), boxes_m.end(), [&](const Box3& box_m) {
    return box_m.squaredExteriorDistance(p_world_m) < margin_m * margin_m ||
           box_m.contains(p_world_m);
  });
}

bool NoFly::allows_leg(const Vec3& from_world_m, const Vec3& to_world_m) const {
  return std::none_of(boxes_m.begin(), boxes_m.end(), [&](const Box3& box_m) {
    return is_approached(box_m, from_world_m, to_world_m, margin_m);
  });
}

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
  return !any_occupied_near(grid, p_world_m, p_world_m, radius_m, [&](const Box3& cube) {
    return cube.squaredExteriorDistance(p_world_m) < radius_m * radius_m;
  });
}

bool is_path_clear(const OccupancyGrid& grid, const Vec3& from_world_m, const Vec3& to_world_m,
                   double radius_m) {
  GNBV_CHECK(from_world_m.allFinite() && to_world_m.allFinite(), "a path to {} {} {}",
             to_world_m.x(), to_world_m.y(), to_world_m.z());
  const double reach_m = radius_m + 0.5 * std::sqrt(3.0) * grid.geometry().resolution_m();
  return !any_occupied_near(grid, from_world_m, to_world_m, radius_m, [&](const Box3& cube) {
    return distance_to_segment_m2(cube.center(), from_world_m, to_world_m) <= reach_m * reach_m &&
           is_approached(cube, from_world_m, to_world_m, radius_m);
  });
}

bool is_line_free(const OccupancyGrid& grid, const Vec3& from_world_m, const Vec3& to_world_m,
                  double radius_m) {
  const GridGeometry& geometry = grid.geometry();
  const Vec3 to_m = geometry.nearest_inside(to_world_m);
  if (!FreeFromVehicle(grid, from_world_m, 0.0).is_free(geometry.key_of(to_m))) return false;
  FreeFromVehicle line(grid, from_world_m, radius_m);
  return all_along_ray(geometry, geometry.nearest_inside(from_world_m).cast<float>(),
                       to_m.cast<float>(), [&](const Key& key) { return line.is_free(key); });
}

bool FreeSpace::contains(const Vec3& p_world_m) const {
  constexpr double kRounding_m = 1e-6;
  return navigation_m.squaredExteriorDistance(p_world_m) <= kRounding_m * kRounding_m;
}

std::optional<Rejection> FreeSpace::rejection_at(const Vec3& p_world_m,
                                                 const Vec3& own_world_m) const {
  if (!contains(p_world_m)) return Rejection::out_of_bounds;
  if (!no_fly.allows(p_world_m)) return Rejection::no_fly;
  const GridGeometry& geometry = grid.geometry();
  const Vec3 inside_m = geometry.nearest_inside(p_world_m);
  const bool may_be_unknown = allow_unknown && grid.state_at(inside_m) == VoxelState::unknown;
  const bool is_free = FreeFromVehicle(grid, own_world_m, 0.0).is_free(geometry.key_of(inside_m));
  if (!is_free && !may_be_unknown) return Rejection::not_free;
  if (!is_sphere_clear(grid, p_world_m, radius_m)) return Rejection::collision;
  return std::nullopt;
}

bool FreeSpace::is_leg_clear(const Vec3& from_world_m, const Vec3& to_world_m) const {
  if (!no_fly.allows_leg(from_world_m, to_world_m)) return false;
  if (is_path_clear(grid, from_world_m, to_world_m, leg_radius_m)) return true;
  if (!leg_keeps_start_room) return false;
  constexpr double kLeastShare = 0.5;
  constexpr double kBeside_m = 0.05;  // that it flies beside the places planned
  const double here_m = clearance_m(grid, from_world_m, leg_radius_m);
  return here_m < leg_radius_m &&
         is_path_clear(grid, from_world_m, to_world_m,
                       std::max(here_m - kBeside_m, kLeastShare * leg_radius_m));
}

bool FreeSpace::is_leg_free(const Vec3& from_world_m, const Vec3& to_world_m) const {
  return (allow_unknown || is_line_free(grid, from_world_m, to_world_m, radius_m)) &&
         is_leg_clear(from_world_m, to_world_m);
}

OpenSpace::OpenSpace(const GridGeometry& geometry, const Box3& navigation_m, const NoFly& no_fly,
                     double radius_m)
    : geometry_(geometry),
      navigation_m_(navigation_m),
      radius_m_(radius_m),
      near_occupied_(geometry.voxel_count()),
      was_occupied_(geometry.voxel_count()) {
  // whether a cube at exactly the radius is near depends on rounding: here it is
  constexpr double kRounding_m = 1e-6;
  const double voxel_m = geometry.resolution_m();
  const auto reach = static_cast<std::int32_t>(std::ceil(radius_m / voxel_m)) + 1;
  const auto gap_m = [&](std::int32_t steps) {  // from the centre to the cube, along an axis
    return std::max(0.0, (std::abs(steps) - 0.5) * voxel_m);
  };
  for_each_key(keys_about({0, 0, 0}, reach), [&](const Key& offset) {
    const Vec3 gaps_m(gap_m(offset[0]), gap_m(offset[1]), gap_m(offset[2]));
    if (gaps_m.norm() < radius_m + kRounding_m) ball_.push_back(offset);
  });
  if (no_fly.boxes_m.empty()) return;
  for (VoxelIndex v = 0; v < geometry.voxel_count(); ++v) {
    if (!no_fly.allows(geometry.center_m(geometry.key_at(v)))) near_occupied_[v] = 1;
  }
}

void OpenSpace::follow(const OccupancyGrid& grid, const HeedStop& stop) {
  const std::span<const VoxelWord> words = grid.words();
  for (std::size_t v = 0; v < words.size(); ++v) {
    const bool is_occupied = state_of(words[v]) == VoxelState::occupied;
    if (is_occupied == (was_occupied_[v] != 0)) continue;
    heed(stop);
    was_occupied_[v] = is_occupied ? 1 : 0;
    const Key center = geometry_.key_at(static_cast<VoxelIndex>(v));
    for (const Key& offset : ball_) {
      const Key key = {center[0] + offset[0], center[1] + offset[1], center[2] + offset[2]};
      if (!geometry_.contains(key)) continue;
      std::uint32_t& count = near_occupied_[geometry_.index_of(key)];
      count = is_occupied ? count + 1 : count - 1;
    }
  }
  passable_.assign((words.size() + kBits - 1) / kBits, 0);
  for (std::size_t v = 0; v < words.size(); ++v) {
    const bool is_free = state_of(words[v]) == VoxelState::free;
    passable_[v / kBits] |= std::uint64_t{is_free && near_occupied_[v] == 0} << (v % kBits);
  }
  followed_ = grid.updates();
}

bool OpenSpace::is_passable(const OccupancyGrid& grid, VoxelIndex v) const {
  if (grid.updates() == followed_) return (passable_[v / kBits] >> v % kBits & 1U) != 0;
  return near_occupied_[v] == 0 && grid.state(v) == VoxelState::free;
}

bool OpenSpace::is_open(const OccupancyGrid& grid, const Key& key) const {
  if (!geometry_.contains(key)) return false;
  const VoxelIndex v = geometry_.index_of(key);
  return is_passable(grid, v) && navigation_m_.contains(geometry_.center_m(key));
}

bool OpenSpace::is_line_open(const OccupancyGrid& grid, const Vec3& from_world_m,
                             const Vec3& to_world_m) const {
  const Vec3 to_m = geometry_.nearest_inside(to_world_m);
  if (!is_open(grid, geometry_.key_of(to_m))) return false;
  FreeFromVehicle line(grid, from_world_m, radius_m_);
  bool is_away = false;    // was anywhere: from there on nothing may be near
  bool is_beyond = false;  // in seen space, too: from there on all has to be passable
  return all_along_ray(geometry_, geometry_.nearest_inside(from_world_m).cast<float>(),
                       to_m.cast<float>(), [&](const Key& key) {
                         if (!geometry_.contains(key)) return false;
                         const VoxelIndex v = geometry_.index_of(key);
                         const bool is_open = is_passable(grid, v);
                         is_beyond = is_beyond || is_open;
                         if (is_beyond) return is_open;
                         const bool may_be_near = !is_away;
                         is_away = is_away || near_occupied_[v] == 0;
                         return line.is_free(key) && (may_be_near || near_occupied_[v] == 0);
                       });
}

}  // namespace gnbv
