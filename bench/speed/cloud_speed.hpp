// How much faster SurfaceCloud is than PCL from scratch, halfway through an aircraft mission.
#pragma once

#include <vector>

#include "bench/speed/speed_row.hpp"

namespace gnbv {

/// Row "leaf_filter_and_density": adding the frames of one view (two cameras, 640 x 480, leaf
/// 0.02 m, voxel 0.2 m) to a cloud of more than a million points of the built-in aircraft; median
/// thread CPU time. The reference: pcl::VoxelGrid of the frames' points, a kd-tree of the whole
/// cloud, and the neighbour counts of every point in the voxels whose density changed. Identical:
/// the number of leaves, point_count and neighbour_sum of those voxels, and no new point within
/// reach of another voxel's points. The cloud of the reference is kept as PCL's, and it is told
/// which voxels changed.
std::vector<SpeedRow> cloud_speed();

}  // namespace gnbv
