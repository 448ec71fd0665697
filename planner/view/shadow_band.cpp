#include "planner/view/shadow_band.hpp"

#include "planner/map/ray_walk.hpp"
#include "sim/core/error.hpp"

namespace gnbv {

ShadowBand::ShadowBand(const ShadowConfig& config, const GridGeometry& grid)
    : shadow_depth_m_(config.shadow_depth_m),
      steps_max_(2.0 * config.shadow_depth_m / grid.resolution_m()),
      steps_(grid.voxel_count() + kPadding) {
  if (!(shadow_depth_m_ > 0.0 && shadow_depth_m_ <= kMaxShadow_voxels * grid.resolution_m())) {
    throw BadInput(fmt::format("shadow_depth_m: {} is not between 0 and {} voxels of {} m",
                               shadow_depth_m_, kMaxShadow_voxels, grid.resolution_m()));
  }
}

void ShadowBand::add(const FrameRays& rays, OccupancyGrid& grid) {
  const GridGeometry& geometry = grid.geometry();
  for (std::size_t i = 0; i < rays.kind.size(); ++i) {
    if (rays.kind[i] != PixelRay::hits) continue;
    const Vec3f hit_m = rays.end_world_m(i);
    const Vec3 along = (hit_m - rays.origin_world_m).cast<double>().normalized();
    const Vec3 end_m = hit_m.cast<double>() + shadow_depth_m_ * along;
    const RayOrigin origin = make_ray_origin(geometry, hit_m);
    int steps = 0;
    walk_ray_inside(geometry, origin, end_m.cast<float>(), [&](VoxelIndex v) {
      if (steps > 0 && grid.shade(v)) {
        const auto now = static_cast<std::uint8_t>(steps);
        steps_[v] = steps_[v] == 0 ? now : std::min(steps_[v], now);
      }
      ++steps;
      return true;
    });
  }
}

bool ShadowBand::restore(VoxelIndex v, int steps, OccupancyGrid& grid) {
  if (steps < 1 || !grid.shade(v)) return false;
  steps_[v] = static_cast<std::uint8_t>(steps);
  return true;
}

}  // namespace gnbv
