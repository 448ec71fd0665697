// Voxels of the map as things to draw.
#pragma once

#include <span>
#include <vector>

#include "bench/score/voxel_set.hpp"
#include "planner/map/occupancy_grid.hpp"
#include "tools/render/scene.hpp"
#include "tools/render/view.hpp"

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

/// Whether an occupied voxel lies between the camera and a place, farther from this than
/// `beside_m`.
bool is_hidden(const OccupancyGrid& grid, const RenderView& view, const Vec3& p_world_m,
               double beside_m);

/// Whether the picture holds the place, and no occupied voxel farther than `beside_m` hides it.
bool shows(const RenderView& view, const OccupancyGrid& grid, const Vec3& p_world_m,
           double beside_m);

/// Whether any of free_faces() is turned to the camera, within its picture, and not hidden.
bool is_seen(const SurfaceItem& faces, const OccupancyGrid& grid, const RenderView& view);

}  // namespace gnbv
