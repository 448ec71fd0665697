// Less of a cloud and of a mesh, so that a page can carry and a laptop can draw it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sim/mesh/triangle_mesh.hpp"

namespace gnbv {

/// Indices, ascending, of the first point in each cube of a lattice with cubes of `cell_m`.
/// Requires cell_m > 0 and points within 2^20 cells of the origin.
std::vector<std::size_t> first_points(std::span<const Vec3f> points_m, double cell_m);

struct ThinnedPoints {
  double cell_m = 0.0;            // 0: nothing had to go
  std::vector<std::size_t> kept;  // ascending
};

/// All points, or the first ones of the finest lattice (of `finest_m` times powers of 1.25) that
/// leaves at most `max_points`. Requires max_points > 0 and finest_m > 0.
ThinnedPoints thinned(std::span<const Vec3f> points_m, std::size_t max_points, double finest_m);

/// The mesh, or the finest of its kind (vertices of a lattice's cubes drawn together, faces without
/// area dropped) that has at most `max_faces`. No vertex moves outside of the mesh's bounds.
TriangleMesh with_fewer_faces(const TriangleMesh& mesh, std::size_t max_faces);

}  // namespace gnbv
