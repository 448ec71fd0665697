#include "planner/map/memory.hpp"

namespace gnbv {

double map_bytes(const std::array<double, 3>& voxels, int threads, std::size_t cameras) {
  constexpr double kGrid = 8.0, kCloud = 4.0, kShadow = 1.0, kFrontierMarks = 1.0;
  constexpr double kBucket = 4.0, kVisitMarks = 1.0, kFanMarks = 1.0;
  const double per_voxel = kGrid + kCloud + kShadow + kFrontierMarks +
                           static_cast<double>(cameras) + kVisitMarks * threads;
  const auto framed = [&](double frame) {
    return (voxels[0] + frame) * (voxels[1] + frame) * (voxels[2] + frame);
  };
  // buckets are no smaller than voxels, and reach two or three of them beyond the grid
  return framed(0.0) * per_voxel + framed(6.0) * kBucket + framed(2.0) * kFanMarks * threads;
}

std::size_t map_bytes(const GridGeometry& grid, int threads, std::size_t cameras) {
  const auto voxels = [&](std::size_t a) { return static_cast<double>(grid.size()[a]); };
  return static_cast<std::size_t>(map_bytes({voxels(0), voxels(1), voxels(2)}, threads, cameras));
}

}  // namespace gnbv
