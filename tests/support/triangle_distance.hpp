// The distance to a mesh, triangle by triangle: slow, and too simple to be wrong.
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "sim/core/pose.hpp"
#include "sim/mesh/triangle_mesh.hpp"

namespace gnbv {

/// To the plane where the foot of the perpendicular lies within the triangle, else to its edges.
inline double distance_to_triangle_m(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  Eigen::Matrix3d axes;
  axes << b - a, c - a, (b - a).cross(c - a);
  if (std::abs(axes.determinant()) > 1e-15) {
    const Vec3 at = axes.inverse() * (p - a);
    if (at.x() >= 0.0 && at.y() >= 0.0 && at.x() + at.y() <= 1.0) {
      return std::abs(at.z()) * axes.col(2).norm();
    }
  }
  return std::min({distance_to_segment_m(p, a, b), distance_to_segment_m(p, b, c),
                   distance_to_segment_m(p, c, a)});
}

inline double distance_to_mesh_m(const TriangleMesh& mesh, const Vec3& p_m) {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const auto& face : mesh.faces) {
    const auto corner = [&](std::size_t i) -> Vec3 {
      return mesh.vertices_m[face[i]].cast<double>();
    };
    nearest_m = std::min(nearest_m, distance_to_triangle_m(p_m, corner(0), corner(1), corner(2)));
  }
  return nearest_m;
}

}  // namespace gnbv
