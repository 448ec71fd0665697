// The one answer to "may I fly there": known to be free, room for the vehicle, no box in the way.
// The vehicle is a sphere, standing or swept along a straight leg, against the occupied voxels of
// the map (paper section 3, Fig. 7).
#pragma once

#include <optional>

#include "planner/map/occupancy_grid.hpp"
#include "planner/motion/no_fly.hpp"
#include "planner/motion/rejection.hpp"

namespace gnbv {

/// Squared distance between a box and a segment, to 2^-24 of the segment's length.
double box_to_segment_m2(const Box3& box_m, const Vec3& a_m, const Vec3& b_m);

/// Whether the leg comes nearer to the box than `radius_m`, and nearer than it is at its start:
/// what is too near already may be left but not approached.
bool is_approached(const Box3& box_m, const Vec3& from_m, const Vec3& to_m, double radius_m);

/// Whether a sphere at the point touches no occupied voxel (a cube).
bool is_sphere_clear(const OccupancyGrid& grid, const Vec3& p_world_m, double radius_m);

/// Whether a sphere swept along the straight leg touches no occupied voxel. A voxel that it touches
/// at the start already, because it was only seen from there, may be left but not approached. Both
/// ends must be finite.
bool is_path_clear(const OccupancyGrid& grid, const Vec3& from_world_m, const Vec3& to_world_m,
                   double radius_m);

/// Whether voxels are known to be free, asked in their order along a line that begins where the
/// vehicle is. Its own voxel is free by definition: no camera sees it. As long as it has not been
/// seen, neither is what is about it: up to the first voxel that has, unknown ones within the
/// vehicle's radius are free, too.
class FreeFromVehicle {
 public:
  FreeFromVehicle(const OccupancyGrid& grid, const Vec3& own_world_m, double radius_m);
  bool is_free(const Key& key);

 private:
  const OccupancyGrid& grid_;
  Vec3 own_m_;
  Key own_;
  double radius_m_;
  bool is_blind_ = true;
};

/// Whether every voxel that the line crosses is known to be free, for a vehicle of that radius
/// where it begins; the last one has to have been seen. Ends on the workspace's faces or beyond
/// count as just inside.
bool is_line_free(const OccupancyGrid& grid, const Vec3& from_world_m, const Vec3& to_world_m,
                  double radius_m = 0.0);

/// Where the vehicle may be and which straight legs it may fly, by what is known now. Refers to
/// what it is made of.
struct FreeSpace {
  const OccupancyGrid& grid;
  const Box3& navigation_m;
  const NoFly& no_fly;
  double radius_m = 0.0;       // of the vehicle's sphere
  bool allow_unknown = false;  // unknown voxels count as free

  /// Whether the navigation box holds the point: a lattice walked in steps ends on the box's faces
  /// but for rounding.
  bool contains(const Vec3& p_world_m) const;
  /// What forbids to be at the point, if anything does, for a vehicle that is at `own_world_m`.
  std::optional<Rejection> rejection_at(const Vec3& p_world_m, const Vec3& own_world_m) const;
  /// Whether the leg keeps away from what is known to be occupied, and from all boxes.
  bool is_leg_clear(const Vec3& from_world_m, const Vec3& to_world_m) const;
  /// The same, and it leads through what is known to be free alone.
  bool is_leg_free(const Vec3& from_world_m, const Vec3& to_world_m) const;
};

}  // namespace gnbv
