#include "planner/map/grid_geometry.hpp"

#include <cmath>

#include "sim/core/error.hpp"

namespace gnbv {

GridGeometry::GridGeometry(const Box3& bounds_m, double resolution_m)
    : resolution_m_(resolution_m), inverse_resolution_(1.0 / resolution_m) {
  constexpr double kBorderSlack =
      1e-6;  // voxels: a bound on a voxel border is on it despite rounding
  constexpr double kKeyRange = 32768.0;  // OctoMap's tree_max_val
  constexpr double kIndexRange = 2147483648.0;
  if (!(resolution_m > 0.0) || !std::isfinite(resolution_m)) {
    throw BadInput(fmt::format("resolution_m: {} is not a positive length", resolution_m));
  }
  double voxels = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const double first = std::floor(bounds_m.min()[axis] * inverse_resolution_ + kBorderSlack);
    const double end = std::ceil(bounds_m.max()[axis] * inverse_resolution_ - kBorderSlack);
    if (!(end > first)) {
      throw BadInput(fmt::format("workspace_m: empty along axis {}: {} to {}", "xyz"[axis],
                                 bounds_m.min()[axis], bounds_m.max()[axis]));
    }
    if (first < -kKeyRange || end > kKeyRange) {
      throw BadInput(
          fmt::format("workspace_m: {} to {} along axis {} exceeds OctoMap's range at "
                      "resolution_m {}",
                      bounds_m.min()[axis], bounds_m.max()[axis], "xyz"[axis], resolution_m));
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
  for (std::size_t a = 0; a < 3 && !box_m.isEmpty(); ++a) {
    const auto axis = static_cast<Eigen::Index>(a);
    keys.low[a] = std::max(key_of(box_m.min()[axis]) - more, min_[a]);
    keys.high[a] = std::min(key_of(box_m.max()[axis]) + more, min_[a] + size_[a] - 1);
  }
  return keys;
}

}  // namespace gnbv
