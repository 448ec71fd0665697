// Whether the profile is one half of a mirror-symmetric structure (paper section 2.3): the plane,
// and the other half.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planner/map/occupancy_grid.hpp"

namespace gnbv {

/// Defaults: the released configuration where it works on the two structures of the paper, our own
/// choice elsewhere (FIDELITY.md).
struct SymmetryConfig {
  bool enabled = true;
  double min_support = 0.9;  // share of mirrored points not contradicted by measured free space
};

/// Points p with normal . p = offset_m; the normal has unit length and points into the half space
/// x > 0 (y > 0 where x is 0, z > 0 where both are).
struct MirrorPlane {
  Vec3 normal_world = Vec3::UnitX();
  double offset_m = 0.0;
};

struct Symmetry {
  std::optional<MirrorPlane> plane;  // nothing: the structure is not symmetric, or not known to be
  double support = 0.0;              // of the best plane, accepted or not
  std::vector<Vec3f> mirrored_world_m;  // the profile seen in the mirror; empty without a plane
};

Vec3 mirrored(const MirrorPlane& plane, const Vec3& p_world_m);

/// Finds the plane from the points of the profile and what the map knows of the space between.
/// Deterministic; throws nothing for few or no points: then there is no plane.
Symmetry find_symmetry(const SymmetryConfig& config, std::span<const Vec3f> profile_world_m,
                       const OccupancyGrid& grid);

/// Marks the mirrored points in the map where it knows nothing; returns how many voxels are marked.
std::size_t predict_surface(const Symmetry& symmetry, OccupancyGrid& grid);

}  // namespace gnbv
