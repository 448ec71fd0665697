// The one answer to "may I fly there": known to be free, room for the vehicle, no box in the way.
// The vehicle is a sphere, standing or swept along a straight leg, against the occupied voxels of
// the map (paper section 3, Fig. 7).
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "planner/map/occupancy_grid.hpp"
#include "planner/motion/config.hpp"

namespace gnbv {

/// Why a view may not be flown to.
enum class Rejection {
  out_of_bounds,
  not_free,
  collision,
  path_blocked,
  recently_visited,
  cluster_outside_fov,  // FVS: the centroid of the cluster is in no camera's frustum
  cluster_hidden,       // FVS: no voxel of the cluster is visible
  sees_no_surface,      // refused by the utility
  no_fly,               // in or too near to a box where nobody may fly
  beyond_gimbal,        // a given view: no gimbal reaches its pitch
  search_limit          // the search for a way around ended at its limit and found none
};

constexpr std::array<std::string_view, 11> kRejectionNames = {
    "out_of_bounds",       "not_free",       "collision",       "path_blocked", "recently_visited",
    "cluster_outside_fov", "cluster_hidden", "sees_no_surface", "no_fly",       "beyond_gimbal",
    "search_limit"};

constexpr std::string_view name_of(Rejection reason) {
  return kRejectionNames[static_cast<std::size_t>(reason)];
}

/// Squared distance between a box and a segment, to 2^-24 of the segment's length.
double box_to_segment_m2(const Box3& box_m, const Vec3& a_m, const Vec3& b_m);

/// Whether a sphere at the point touches no occupied voxel (a cube).
bool is_sphere_clear(const OccupancyGrid& grid, const Vec3& p_world_m, double radius_m);

/// Whether a sphere swept along the straight leg touches no occupied voxel. A voxel that it touches
/// at the start, because it was only seen from there, may be left but not approached. Both ends
/// must be finite.
bool is_path_clear(const OccupancyGrid& grid, const Vec3& from_world_m, const Vec3& to_world_m,
                   double radius_m);

/// Whether every voxel that the line crosses is known to be free. The vehicle stands where the line
/// begins: its own voxel is free by definition, since no camera sees it. While that voxel is
/// unseen, unknown ones within the radius are free, too, up to the first voxel that was seen. The
/// last voxel has to have been seen. Ends on the workspace's faces or beyond count as just inside.
bool is_line_free(const OccupancyGrid& grid, const Vec3& from_world_m, const Vec3& to_world_m,
                  double radius_m = 0.0);

/// Where the vehicle may be and which straight legs it may fly, by what is known now. Refers to
/// what it is made of.
struct FreeSpace {
  const OccupancyGrid& grid;
  const Box3& navigation_m;
  const NoFly& no_fly;
  double radius_m = 0.0;           // of the vehicle's sphere
  bool allow_unknown = false;      // unknown voxels count as free
  double leg_radius_m = radius_m;  // of the sphere on a leg
  /// Where the start of a leg has less room than that, such as under a wing that was seen late, the
  /// leg may have as little, less 5 cm, but at least half the radius. The paper has no such rule.
  bool leg_keeps_start_room = false;

  /// Whether the navigation box holds the point: a lattice walked in steps ends on the box's faces
  /// but for rounding.
  bool contains(const Vec3& p_world_m) const;
  /// What forbids the point, if anything does, to a vehicle that is at `own_world_m`.
  std::optional<Rejection> rejection_at(const Vec3& p_world_m, const Vec3& own_world_m) const;
  /// Whether the leg keeps away from what is known to be occupied, and from all boxes.
  bool is_leg_clear(const Vec3& from_world_m, const Vec3& to_world_m) const;
  /// The same, and it leads through what is known to be free alone.
  bool is_leg_free(const Vec3& from_world_m, const Vec3& to_world_m) const;
};

/// FreeSpace voxel by voxel, for whoever asks about many: keeps count of what is too near to each.
/// All questions are about the grid that was followed, which may have changed since.
class OpenSpace {
 public:
  OpenSpace(const GridGeometry& geometry, const Box3& navigation_m, const NoFly& no_fly,
            double radius_m);

  /// Takes up what became occupied since the last call, or ceased to be.
  void follow(const OccupancyGrid& grid, const HeedStop& stop = {});

  /// Whether the vehicle may stand in the middle of the voxel: is_sphere_clear, but a cube at the
  /// radius to within rounding is near.
  bool is_open(const OccupancyGrid& grid, const Key& key) const;
  /// Whether all voxels that the line crosses are open. Those about the start, up to the first open
  /// one, need only be free: it may have been seen from there that the start is too near.
  bool is_line_open(const OccupancyGrid& grid, const Vec3& from_world_m,
                    const Vec3& to_world_m) const;

 private:
  /// Whether the voxel is free, and nothing too near to it.
  bool is_passable(const OccupancyGrid& grid, VoxelIndex v) const;

  GridGeometry geometry_;
  Box3 navigation_m_;
  double radius_m_;
  std::vector<Key> ball_;                     // offsets at which an occupied voxel is too near
  ZeroedArray<std::uint32_t> near_occupied_;  // so many, and one more where nobody may fly
  ZeroedArray<std::uint8_t> was_occupied_;
  // is_passable() of each voxel, as long as the grid stays as it was followed: a bit each, so that
  // a processor's cache holds them
  static constexpr std::size_t kBits = 64;
  std::vector<std::uint64_t> passable_;
  std::uint64_t followed_ = std::numeric_limits<std::uint64_t>::max();  // OccupancyGrid::updates()
};

}  // namespace gnbv
