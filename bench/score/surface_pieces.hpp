// The surface cut into what lies in each voxel: exact areas, and points spread evenly over them.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "sim/mesh/triangle_mesh.hpp"

namespace gnbv {

/// The part of one face that lies in one voxel of kCoverageSizes_m[0], above the floor.
struct SurfacePiece {
  std::uint64_t voxel = 0;
  std::uint32_t face = 0;
  double area_m2 = 0.0;
  std::span<const Vec3> corners_world_m;  // convex, three to ten of them
};

/// Slabs along x are cubes' widths of the coarsest voxels: no voxel of any size straddles two.
/// Slab k covers [k, k + 1) times this.
constexpr double kSlab_m = 0.5;

/// The slabs of a mesh, and which faces reach into each above the floor.
struct Slabs {
  std::int64_t first = 0;
  std::vector<std::vector<std::uint32_t>> faces;

  std::int64_t slab(std::size_t index) const { return first + static_cast<std::int64_t>(index); }
};

/// Throws BrokenInvariant for a mesh that reaches farther than voxels do (voxel_code).
Slabs make_slabs(const TriangleMesh& mesh, double floor_z_m);

/// Calls use(piece) for each piece of the face in the slab: together they are the part of the face
/// that lies in it and not below the floor, cut by Sutherland and Hodgman's clipping (1974) in
/// double precision. Pieces without area are left out.
void for_each_piece(const TriangleMesh& mesh, std::uint32_t face, std::int64_t slab,
                    double floor_z_m, const std::function<void(const SurfacePiece&)>& use);

/// Calls use(k, area_m2) for each cube [k, k + 1) cell_m that has a part of the piece.
void for_each_part(const SurfacePiece& piece, double cell_m,
                   const std::function<void(const std::array<std::int64_t, 3>&, double)>& use);

/// How many points a piece gets: one for each spacing_m^2 of it, rounded, but at least one.
std::size_t points_on(const SurfacePiece& piece, double spacing_m);

/// The k-th of `count` points spread evenly over the piece (Roberts' R2 sequence, shifted by a hash
/// of voxel and face, so that like pieces have unlike points), in the piece's voxel.
Vec3f point_on(const SurfacePiece& piece, std::size_t k);

/// So many points drawn by area, each by itself, from all faces' parts that are not below the
/// floor; none where these have no area. The draws are keyed by their numbers alone: a mesh has the
/// same points for every mission, and those of a scaled mesh are the scaled ones.
std::vector<Vec3f> drawn_by_area(const TriangleMesh& mesh, double floor_z_m, std::size_t count);

}  // namespace gnbv
