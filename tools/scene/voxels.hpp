// Voxels and clouds as things to draw, and what they hide.
#pragma once

#include <span>
#include <vector>

#include "bench/score/voxel_set.hpp"
#include "planner/map/occupancy_grid.hpp"
#include "tools/scene/scene.hpp"

namespace gnbv {

/// Voxels to tell apart, each list in ascending order.
struct SortedVoxels {
  std::vector<VoxelIndex> occupied;
  std::vector<VoxelIndex> predicted;  // by symmetry, never measured
  /// Unknown, next to a free one (by a face) and at most kNearSurface_voxels from an occupied or
  /// predicted one: what is left to find out, not all that was never looked at.
  std::vector<VoxelIndex> unknown;
};
constexpr int kNearSurface_voxels = 3;

SortedVoxels sort_voxels(const OccupancyGrid& grid);

/// A cube a voxel, `share` of it wide; colours (n), or one for all.
SurfaceItem voxel_cubes(const GridGeometry& geometry, std::span<const VoxelIndex> voxels,
                        std::span<const Rgb> colours, double share = 0.9);

/// Voxels of one size as a closed surface: only the faces to what is not in the set. `colours` (n).
SurfaceItem exposed_faces(const VoxelSet& voxels, double size_m, std::span<const Rgb> colours);

/// The faces that part the voxels from free ones, as a ghost.
SurfaceItem free_faces(const OccupancyGrid& grid, std::span<const VoxelIndex> voxels,
                       const Rgb& colour, float opacity);

/// Whether the picture holds the place, and no occupied voxel farther from it than `beside_m` hides
/// it.
bool shows(const RenderView& view, const OccupancyGrid& grid, const Vec3& p_world_m,
           double beside_m);

/// Whether the picture shows anything of that colour: a ball, a dot, the middle of a tube, or of a
/// face of the surfaces above. These may lie within an occupied voxel, but not behind it.
bool shows_any(const RenderView& view, const OccupancyGrid& grid, const RenderScene& scene,
               const Rgb& colour);

/// Unit normal at each point, either side: the least principal axis of the points in the 3 x 3 x 3
/// cells around its own, `cell_m` wide, the same for all points of a cell. Zero where fewer than
/// three points or no plane tell it.
std::vector<Vec3f> point_normals(std::span<const Vec3f> points_world_m, double cell_m);

/// Dots of a cloud whose points lie a leaf apart, lit as the surface that they are on.
DotsItem cloud_dots(std::span<const Vec3f> points_world_m, double leaf_m, const Rgb& colour);

}  // namespace gnbv
