#include "planner/map/memory.hpp"

namespace gnbv {

double map_bytes(const Box3& workspace_m, double resolution_m, int threads, std::size_t cameras) {
  constexpr double kGrid = 8.0, kCloud = 4.0, kShadow = 1.0, kFrontierMarks = 1.0;
  constexpr double kBucket = 4.0, kVisitMarks = 1.0, kFanMarks = 1.0;
  constexpr double kBorderSlack = 1e-6;  // as GridGeometry's
  const double per_voxel = kGrid + kCloud + kShadow + kFrontierMarks +
                           static_cast<double>(cameras) + kVisitMarks * threads;
  const Eigen::Array3d first = (workspace_m.min().array() / resolution_m + kBorderSlack).floor();
  const Eigen::Array3d end = (workspace_m.max().array() / resolution_m - kBorderSlack).ceil();
  const auto framed = [&](double frame) { return (end - first + frame).prod(); };
  // buckets are no smaller than voxels, and reach two or three of them beyond the grid
  return framed(0.0) * per_voxel + framed(6.0) * kBucket + framed(2.0) * kFanMarks * threads;
}

}  // namespace gnbv
