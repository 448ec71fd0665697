#include "planner/map/grid_geometry.hpp"

#include <cmath>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

constexpr double kBorderSlack = 1e-6;  // voxels: a bound on a border is on it despite rounding

}  // namespace

GridGeometry::GridGeometry(const Box3& bounds_m, double resolution_m)
    : resolution_m_(resolution_m), inverse_resolution_(1.0 / resolution_m) {
  constexpr double kKeyRange = 32768.0;  // OctoMap's tree_max_val
  constexpr double kIndexRange = 2147483648.0;
  if (!(resolution_m > 0.0) || !std::isfinite(resolution_m)) {
    throw BadInput(fmt::format("resolution_m: {} is not a positive length", resolution_m));
  }
  double voxels = 1.0;
  for (int a = 0; a < 3; ++a) {
    const double low_m = bounds_m.min()[a];
    const double high_m = bounds_m.max()[a];
    const double first = std::floor(low_m * inverse_resolution_ + kBorderSlack);
    const double end = std::ceil(high_m * inverse_resolution_ - kBorderSlack);
    if (!(end > first)) {
      throw BadInput(
          fmt::format("workspace_m: empty along axis {}: {} to {}", "xyz"[a], low_m, high_m));
    }
    if (first < -kKeyRange || end > kKeyRange) {
      throw BadInput(
          fmt::format("workspace_m: {} to {} along axis {} exceeds OctoMap's range at "
                      "resolution_m {}",
                      low_m, high_m, "xyz"[a], resolution_m));
    }
    min_[a] = static_cast<std::int32_t>(first);
    size_[a] = static_cast<std::int32_t>(end - first);
    voxels *= end - first + 2.0;  // the ray walker frames the grid with one voxel on each side
  }
  if (voxels >= kIndexRange) {
    throw BadInput(
        fmt::format("resolution_m: {} makes {:.3g} voxels, more than 2^31", resolution_m, voxels));
  }
}

KeyBox GridGeometry::keys_in(const Box3& box_m, std::int32_t more) const {
  KeyBox keys;
  for (int a = 0; a < 3 && !box_m.isEmpty(); ++a) {
    keys.low[a] = std::max(key_of(box_m.min()[a]) - more, min_[a]);
    keys.high[a] = std::min(key_of(box_m.max()[a]) + more, min_[a] + size_[a] - 1);
  }
  return keys;
}

double map_bytes(const Box3& workspace_m, double resolution_m, int threads, std::size_t cameras) {
  constexpr double kGrid = 8.0, kCloud = 4.0, kShadow = 1.0, kFrontierMarks = 1.0;
  constexpr double kBucket = 4.0, kVisitMarks = 1.0, kFanMarks = 1.0;
  const double per_voxel = kGrid + kCloud + kShadow + kFrontierMarks +
                           static_cast<double>(cameras) + kVisitMarks * threads;
  const Eigen::Array3d first = (workspace_m.min().array() / resolution_m + kBorderSlack).floor();
  const Eigen::Array3d end = (workspace_m.max().array() / resolution_m - kBorderSlack).ceil();
  const auto framed = [&](double frame) { return (end - first + frame).prod(); };
  // buckets are no smaller than voxels, and reach two or three of them beyond the grid
  return framed(0.0) * per_voxel + framed(6.0) * kBucket + framed(2.0) * kFanMarks * threads;
}

}  // namespace gnbv
