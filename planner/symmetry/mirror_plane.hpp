// Planes as mirrors: their one normal form, and how near two of them are.
#pragma once

#include <span>
#include <vector>

#include "sim/core/pose.hpp"

namespace gnbv {

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

}  // namespace gnbv
