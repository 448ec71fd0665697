// What is believed about the surface: a leaf-filtered cloud with an exact, incremental density.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planner/map/grid_geometry.hpp"

namespace gnbv {

/// Defaults: the released filter sizes.
struct CloudConfig {
  double leaf_m = 0.02;          // RGBD points
  double profile_leaf_m = 0.1;   // LIDAR points
};

/// Points with at most one a leaf. Leaves are cubes [k leaf, (k + 1) leaf). A leaf gets the centroid
/// of the points that the first batch to reach it put there, and keeps it.
///
/// Density (paper section 2.1, Fig. 3): mean, over the cloud points in a voxel, of the number of
/// cloud points within r = voxel / sqrt(2), the point itself included. Counts are integers, kept
/// exact as points arrive: equal to a full recomputation at any time.
class SurfaceCloud {
 public:
  SurfaceCloud(const CloudConfig& config, const GridGeometry& voxels);

  /// Adds one batch (a frame, a profile) through the leaf filter of `leaf_m`, then the cloud's own.
  /// Points outside the workspace are ignored. Returns how many points the cloud gained.
  std::size_t add(std::span<const Vec3f> points_world_m, double leaf_m);

  std::span<const Vec3f> points_world_m() const { return points_; }
  /// Points per voxel of the occupancy grid.
  std::uint32_t point_count(VoxelIndex v) const { return point_count_[v]; }
  /// Mean neighbour count of the points in the voxel; 0 without points.
  double density(VoxelIndex v) const {
    return point_count_[v] == 0 ? 0.0
                                : static_cast<double>(neighbour_sum_[v]) / point_count_[v];
  }
  /// Density of a fully scanned plane: 3 (voxel / leaf)^2, the released normaliser.
  double density_max() const { return density_max_; }

 private:
  struct Bucket;
  CloudConfig config_;
  GridGeometry voxels_;
  double density_max_ = 0.0;
  double search_radius_m_ = 0.0;
  std::vector<Vec3f> points_;
  std::vector<std::uint32_t> point_count_;
  std::vector<std::uint64_t> neighbour_sum_;
  // implementation: buckets of whole leaves at least one search radius wide
};

}  // namespace gnbv
