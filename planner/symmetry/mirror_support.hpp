// What the map says about a mirror plane.
#pragma once

#include <span>

#include "planner/map/occupancy_grid.hpp"
#include "planner/symmetry/mirror_plane.hpp"

namespace gnbv {

/// Shares of the mirrored points that move by more than a few voxels: those nearer to the plane
/// stay where they are in any world.
struct MirrorSupport {
  double support = 0.0;  // not contradicted: neither amid measured free space nor outside the grid
  double confirmed = 0.0;  // within a voxel of measured surface
  double moved = 0.0;      // of all points
};

/// Points should lie in occupied voxels. A mirrored point is amid free space when its voxel and all
/// 26 around it are free: nearer to what is not known to be free, the position of a surface is
/// uncertain. The structure stands inside the workspace, so that beyond the grid counts as free.
MirrorSupport mirror_support(const OccupancyGrid& grid, std::span<const Vec3f> points_world_m,
                             const MirrorPlane& plane);

}  // namespace gnbv
