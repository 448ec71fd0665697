// Clouds as the paper's code filters and counts them: PCL, from scratch each time.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim/core/pose.hpp"

namespace gnbv {

/// pcl::VoxelGrid: one centroid a leaf, in PCL's order.
std::vector<Vec3f> pcl_leaf_filter(std::span<const Vec3f> points_m, double leaf_m);

/// For each point, how many of the points lie within `radius_m` of it, itself included
/// (pcl::KdTreeFLANN, built anew). FLANN asks for less than the squared radius: a pair at exactly
/// that float32 distance, which SurfaceCloud counts, is counted here as well.
std::vector<std::uint32_t> pcl_neighbour_counts(std::span<const Vec3f> points_m, double radius_m);

}  // namespace gnbv
