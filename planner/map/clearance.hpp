// Room for the vehicle: a sphere, standing or swept along a straight path, against the occupied
// voxels of the map (paper section 3, Fig. 7).
#pragma once

#include "planner/map/occupancy_grid.hpp"

namespace gnbv {

/// Squared distance between a box and a segment, to 2^-24 of the segment's length.
double box_to_segment_m2(const Box3& box_m, const Vec3& a_m, const Vec3& b_m);

/// Whether a sphere at the point touches no occupied voxel (a cube).
bool is_sphere_clear(const OccupancyGrid& grid, const Vec3& p_world_m, double radius_m);

/// Whether a sphere swept along the straight path touches no occupied voxel. A voxel that it
/// touches at the start already, because it was only seen from there, may be left but not
/// approached. Both ends must be finite.
bool is_path_clear(const OccupancyGrid& grid, const Vec3& from_world_m, const Vec3& to_world_m,
                   double radius_m);

/// Whether every voxel that the line crosses is known to be free; ends on the workspace's faces or
/// beyond count as just inside.
bool is_line_free(const OccupancyGrid& grid, const Vec3& from_world_m, const Vec3& to_world_m);

}  // namespace gnbv
