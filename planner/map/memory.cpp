#include "planner/map/memory.hpp"

namespace gnbv {

double map_bytes(const std::array<double, 3>& voxels, int threads, std::size_t cameras) {
  constexpr double kGrid_bytes = 8.0;
  constexpr double kCloud_bytes = 4.0;
  constexpr double kBucket_bytes = 4.0;
  const double marks_bytes = 2.0 + static_cast<double>(cameras);
  constexpr double kVisit_bytes = 1.0;
  constexpr double kWalk_bytes = 1.0;
  const auto framed = [&](double frame) {
    return (voxels[0] + frame) * (voxels[1] + frame) * (voxels[2] + frame);
  };
  // buckets are no smaller than voxels, and reach two or three of them beyond the grid
  return framed(0.0) * (kGrid_bytes + kCloud_bytes + marks_bytes + kVisit_bytes * threads) +
         framed(6.0) * kBucket_bytes + framed(2.0) * kWalk_bytes * threads;
}

std::size_t map_bytes(const GridGeometry& grid, int threads, std::size_t cameras) {
  const Key& size = grid.size();
  return static_cast<std::size_t>(map_bytes(
      {static_cast<double>(size[0]), static_cast<double>(size[1]), static_cast<double>(size[2])},
      threads, cameras));
}

}  // namespace gnbv
