// How much faster SurfaceCloud is than PCL from scratch, halfway through an aircraft mission.
#pragma once

#include <vector>

#include "bench/speed/speed_row.hpp"

namespace gnbv {

/// Row "leaf_filter_and_density": adding the frames of one view (two cameras, 640 x 480, leaf
/// 0.02 m, voxel 0.2 m) to a cloud of more than a million points of the built-in aircraft; median
/// thread CPU time. The reference: pcl::VoxelGrid of the frames' points, a kd-tree of the whole
/// cloud, and the neighbour counts of every point in the voxels that received points. Its clouds
/// are PCL's before the clock runs, and it is told which voxels those are. The competent way:
/// KdDensityTwin, from the hits on. Identical: the number of leaves; for PCL, point_count and
/// neighbour_sum of all voxels whose density changed, and no new point within reach of another
/// voxel's points; for the competent way, those of every voxel.
std::vector<SpeedRow> cloud_speed();

}  // namespace gnbv
