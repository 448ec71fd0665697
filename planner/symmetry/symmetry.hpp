// Whether the profile is one half of a mirror-symmetric structure (paper section 2.3): the plane,
// and the other half.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "planner/map/occupancy_grid.hpp"

namespace gnbv {

/// Defaults: the released configuration where it works on the two structures of the paper, our own
/// choice elsewhere (FIDELITY.md).
struct SymmetryConfig {
  bool enabled = true;
  double min_support = 0.985;  // share of mirrored points not contradicted by measured free space
  double min_confirmed = 0.4;  // share of them that falls on measured surface
};

/// Points p with normal . p = offset_m; the normal has unit length and points into the half space
/// x > 0 (y > 0 where x is 0, z > 0 where both are).
struct MirrorPlane {
  Vec3 normal_world = Vec3::UnitX();
  double offset_m = 0.0;
};

inline Vec3 mirrored(const MirrorPlane& plane, const Vec3& p_world_m) {
  return p_world_m -
         2.0 * (plane.normal_world.dot(p_world_m) - plane.offset_m) * plane.normal_world;
}

/// The plane with that normal, of any length but 0, through the point.
inline MirrorPlane plane_through(const Vec3& p_world_m, const Vec3& normal_world) {
  Vec3 n = normal_world.normalized();
  const bool is_folded = n.x() != 0.0 ? n.x() < 0.0 : (n.y() != 0.0 ? n.y() < 0.0 : n.z() < 0.0);
  if (is_folded) n = -n;
  return {n, n.dot(p_world_m)};
}

/// The part of space whose mirroring matters.
struct Extent {
  Vec3 center_world_m = Vec3::Zero();
  double radius_m = 1.0;
};

/// How far apart the planes mirror the extent: the distance of (radius normal, offset from the
/// centre), in metres, so that neither angle nor offset needs a scale of its own. A plane and its
/// opposite are one.
double distance_m(const MirrorPlane& a, const MirrorPlane& b, const Extent& extent);

/// The mean of planes that are much alike, and how many are within the bandwidth.
struct PlaneCluster {
  MirrorPlane plane;
  std::size_t votes = 0;
};

/// Mean shift with a flat kernel over distance_m(). Most votes first.
std::vector<PlaneCluster> cluster_planes(std::span<const MirrorPlane> planes, const Extent& extent,
                                         double bandwidth_m);

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
/// for. Deterministic; nothing for few or no points, and when disabled. Throws BadInput when
/// symmetry_module() does.
Symmetry find_symmetry(const SymmetryConfig& config, std::span<const Vec3f> profile_world_m,
                       const OccupancyGrid& grid, int threads = 1);

/// Marks the mirrored points in the map where it knows nothing; returns how many voxels of the map
/// are marked then.
std::size_t predict_surface(const Symmetry& symmetry, OccupancyGrid& grid);

/// At most `max` of them, evenly chosen: all, when there are no more.
template <typename List>
List evenly(List all, std::size_t max) {
  if (all.size() <= max) return all;
  List chosen(max);
  for (std::size_t i = 0; i < max; ++i) chosen[i] = all[i * all.size() / max];
  return chosen;
}

/// A surface point with the direction in which the space before it is free, of any length; zero
/// where that is not known.
struct ProfilePoint {
  Vec3f p_world_m = Vec3f::Zero();
  Vec3f outward_world = Vec3f::Zero();
  Vec3f normal_world = Vec3f::Zero();  // unit, outwards; zero where there is none
  float curvature = 0.0F;
};

/// Two keypoints, each of which looks like the other in a mirror; unit normals of the surface.
struct KeypointPair {
  Vec3f a_world_m, b_world_m;
  Vec3f a_normal_world, b_normal_world;
};

/// What the program asks of PCL, which sits in a module of its own (symmetry_pcl.cpp): linked, its
/// libraries would cost every start 140 ms.
struct SymmetryModule {
  /// Fills normals and curvatures of the points [begin, end) from their neighbours among all. Calls
  /// for other points may run at once.
  void (*estimate_normals)(std::span<ProfilePoint> profile, std::size_t begin, std::size_t end);
  /// Finds keypoints and pairs them by feature, the best matches of each. Needs the normals.
  void (*match_keypoints)(std::span<const ProfilePoint> profile, std::vector<KeypointPair>& pairs);
  /// Moves the plane to where the mirrored profile fits the profile best. Needs the normals; calls
  /// for other planes may run at once.
  void (*refine_plane)(std::span<const ProfilePoint> profile, MirrorPlane& plane);
};

/// Loads the module from beside the program, or from where it was built, when it is first needed.
/// Throws BadInput, saying why, when it cannot be loaded. It stays loaded.
const SymmetryModule& symmetry_module();

}  // namespace gnbv
