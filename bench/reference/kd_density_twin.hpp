// Leaf filter and density as somebody does them who knows the data structures: a hash set of
// leaves, and an index of the points that grows with them. The competent counterpart of
// pcl_twin.hpp.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "planner/map/grid_geometry.hpp"

namespace gnbv {

/// SurfaceCloud's rules: one point a leaf, the centroid of the first batch that reached it; for
/// each voxel the number of its points and the sum of their neighbours within the radius.
class KdDensityTwin {
 public:
  KdDensityTwin(double leaf_m, double radius_m, const GridGeometry& voxels);
  ~KdDensityTwin();
  KdDensityTwin(const KdDensityTwin&) = delete;
  KdDensityTwin& operator=(const KdDensityTwin&) = delete;

  /// Points outside of the workspace are ignored. One search for each new point (nanoflann's
  /// dynamic kd-trees), which tells its older neighbours as well.
  void add(std::span<const Vec3f> points_world_m);

  std::span<const Vec3f> points_world_m() const;
  std::uint32_t point_count(VoxelIndex v) const;
  std::uint64_t neighbour_sum(VoxelIndex v) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gnbv
