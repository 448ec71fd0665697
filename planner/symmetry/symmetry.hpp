// Whether the profile is one half of a mirror-symmetric structure (paper section 2.3): the plane,
// and the other half.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "planner/map/occupancy_grid.hpp"
#include "planner/symmetry/config.hpp"
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

struct Symmetry {
  std::optional<MirrorPlane> plane;  // nothing: the structure is not symmetric, or not known to be
  double support = 0.0;              // of the best plane, accepted or not
  double confirmed = 0.0;            // of the same plane
  std::vector<Vec3f> mirrored_world_m;  // the profile seen in the mirror; empty without a plane
};

/// Finds the plane from the points of the profile and what the map knows of the space between.
/// Structures stand on the ground, so that only planes within 10 degrees of upright are looked
/// for. Deterministic; nothing for few or no points, and when disabled. Throws BadInput when the
/// module that looks for it (planner/symmetry/symmetry_module.hpp) cannot be loaded.
Symmetry find_symmetry(const SymmetryConfig& config, std::span<const Vec3f> profile_world_m,
                       const OccupancyGrid& grid, int threads = 1);

/// Marks the mirrored points in the map where it knows nothing; returns how many voxels of the map
/// are marked then.
std::size_t predict_surface(const Symmetry& symmetry, OccupancyGrid& grid);

}  // namespace gnbv
