#include "planner/symmetry/mirror_support.hpp"

#include <cmath>

namespace gnbv {
namespace {

enum class Verdict { contradicted, open, confirmed };

/// From the voxel and the 26 around it; those outside the grid are unknown.
Verdict verdict_at(const OccupancyGrid& grid, const Key& key) {
  const GridGeometry& geometry = grid.geometry();
  if (!geometry.contains(key)) return Verdict::contradicted;
  bool is_free = true;
  for (std::int32_t dz = -1; dz <= 1; ++dz) {
    for (std::int32_t dy = -1; dy <= 1; ++dy) {
      for (std::int32_t dx = -1; dx <= 1; ++dx) {
        const Key near = {key[0] + dx, key[1] + dy, key[2] + dz};
        const VoxelState state =
            geometry.contains(near) ? grid.state(geometry.index_of(near)) : VoxelState::unknown;
        if (state == VoxelState::occupied) return Verdict::confirmed;
        is_free = is_free && state == VoxelState::free;
      }
    }
  }
  return is_free ? Verdict::contradicted : Verdict::open;
}

}  // namespace

MirrorSupport mirror_support(const OccupancyGrid& grid, std::span<const Vec3f> points_world_m,
                             const MirrorPlane& plane) {
  constexpr double kMovedVoxels = 4.0;
  const double moved_min_m = kMovedVoxels * grid.geometry().resolution_m();
  std::size_t moved = 0;
  std::size_t contradicted = 0;
  std::size_t confirmed = 0;
  for (const Vec3f& point : points_world_m) {
    const Vec3 p_world_m = point.cast<double>();
    const Vec3 image_world_m = mirrored(plane, p_world_m);
    if ((image_world_m - p_world_m).norm() < moved_min_m) continue;
    ++moved;
    const Verdict verdict = verdict_at(grid, grid.geometry().key_of(image_world_m));
    contradicted += verdict == Verdict::contradicted;
    confirmed += verdict == Verdict::confirmed;
  }
  if (moved == 0) return {};
  const auto total = static_cast<double>(moved);
  return {1.0 - static_cast<double>(contradicted) / total, static_cast<double>(confirmed) / total,
          total / static_cast<double>(points_world_m.size())};
}

}  // namespace gnbv
