// What a map needs, known before anything is allocated.
#pragma once

#include <array>
#include <cstddef>

#include "planner/map/grid_geometry.hpp"

namespace gnbv {

/// Larger maps are refused before the start.
constexpr double kMapBudget_bytes = 6.0 * 1024 * 1024 * 1024;

/// The most that the dense arrays of a map of so many voxels along x, y and z take, once every page
/// of them is written. A voxel takes 8 bytes in OccupancyGrid (float32 log-odds, VoxelWord), 4 in
/// SurfaceCloud and 4 in its buckets, 1 each in ShadowBand, the frontier marks and the
/// FrameInserter of each camera, and 2 for each thread (VisitMarks, FanWalker). Not counted are
/// what grows with the surface, some 50 to 150 bytes a point of the cloud, and the arrays of a
/// planner of its own.
double map_bytes(const std::array<double, 3>& voxels, int threads, std::size_t cameras);
std::size_t map_bytes(const GridGeometry& grid, int threads, std::size_t cameras);

}  // namespace gnbv
