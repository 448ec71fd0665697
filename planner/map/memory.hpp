// What a map needs, known before anything is allocated.
#pragma once

#include <array>
#include <cstddef>

#include "planner/map/grid_geometry.hpp"

namespace gnbv {

/// Larger maps are refused before the start.
constexpr double kMapBudget_bytes = 6.0 * 1024 * 1024 * 1024;

/// The most the dense arrays of a map of so many voxels along x, y and z can take, once every page
/// of them is written: OccupancyGrid 8 bytes a voxel (float32 log-odds, VoxelWord), SurfaceCloud 4
/// and 4 for each of its buckets, ShadowBand, frontier marks and the FrameInserter of each camera 1
/// each, and a thread 2 (VisitMarks, FanWalker). Not in it: what grows with the surface, some 50 to
/// 150 bytes a point of the cloud.
double map_bytes(const std::array<double, 3>& voxels, int threads, std::size_t cameras);
std::size_t map_bytes(const GridGeometry& grid, int threads, std::size_t cameras);

}  // namespace gnbv
