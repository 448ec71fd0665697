// What a map needs, known before anything is allocated.
#pragma once

#include <cstddef>

#include "sim/core/pose.hpp"

namespace gnbv {

/// Larger maps are refused before the start.
constexpr double kMapBudget_bytes = 6.0 * 1024 * 1024 * 1024;

/// The most that the dense arrays of a map take, once every page of them is written. A voxel takes
/// 8 bytes in OccupancyGrid (float32 log-odds, VoxelWord), 4 in SurfaceCloud and 4 in its buckets,
/// 1 each in ShadowBand, the frontier marks and the FrameInserter of each camera, and 2 for each
/// thread (VisitMarks, FanWalker). Not counted are what grows with the surface, some 50 to 150
/// bytes a point of the cloud, and a planner's own arrays (planning_bytes() in planner/planners.hpp
/// has them).
double map_bytes(const Box3& workspace_m, double resolution_m, int threads, std::size_t cameras);

}  // namespace gnbv
