#include "planner/motion/open_space.hpp"

#include <cmath>

#include "planner/map/ray_walk.hpp"
#include "planner/motion/free_space.hpp"

namespace gnbv {

OpenSpace::OpenSpace(const GridGeometry& geometry, const Box3& navigation_m, const NoFly& no_fly,
                     double radius_m)
    : geometry_(geometry),
      navigation_m_(navigation_m),
      radius_m_(radius_m),
      near_occupied_(geometry.voxel_count()),
      was_occupied_(geometry.voxel_count()) {
  // a cube at exactly the radius is near to some ways of rounding
  constexpr double kRounding_m = 1e-6;
  const double voxel_m = geometry.resolution_m();
  const auto reach = static_cast<std::int32_t>(std::ceil(radius_m / voxel_m)) + 1;
  const auto gap_m = [&](std::int32_t steps) {  // from the centre to the cube, along an axis
    return std::max(0.0, (std::abs(steps) - 0.5) * voxel_m);
  };
  for (std::int32_t z = -reach; z <= reach; ++z) {
    for (std::int32_t y = -reach; y <= reach; ++y) {
      for (std::int32_t x = -reach; x <= reach; ++x) {
        if (Vec3(gap_m(x), gap_m(y), gap_m(z)).norm() < radius_m + kRounding_m) {
          ball_.push_back({x, y, z});
        }
      }
    }
  }
  if (no_fly.boxes_m.empty()) return;
  for (VoxelIndex v = 0; v < geometry.voxel_count(); ++v) {
    if (!no_fly.allows(geometry.center_m(geometry.key_at(v)))) near_occupied_[v] = 1;
  }
}

void OpenSpace::follow(const OccupancyGrid& grid) {
  const std::span<const VoxelWord> words = grid.words();
  for (std::size_t v = 0; v < words.size(); ++v) {
    const bool is_occupied = state_of(words[v]) == VoxelState::occupied;
    if (is_occupied == (was_occupied_[v] != 0)) continue;
    was_occupied_[v] = is_occupied ? 1 : 0;
    const Key center = geometry_.key_at(static_cast<VoxelIndex>(v));
    for (const Key& offset : ball_) {
      const Key key = {center[0] + offset[0], center[1] + offset[1], center[2] + offset[2]};
      if (!geometry_.contains(key)) continue;
      std::uint32_t& count = near_occupied_[geometry_.index_of(key)];
      count = is_occupied ? count + 1 : count - 1;
    }
  }
}

bool OpenSpace::is_open(const OccupancyGrid& grid, const Key& key) const {
  if (!geometry_.contains(key)) return false;
  const VoxelIndex v = geometry_.index_of(key);
  return near_occupied_[v] == 0 && grid.state(v) == VoxelState::free &&
         navigation_m_.contains(geometry_.center_m(key));
}

bool OpenSpace::is_line_open(const OccupancyGrid& grid, const Vec3& from_world_m,
                             const Vec3& to_world_m) const {
  const Vec3 to_m = geometry_.nearest_inside(to_world_m);
  if (!is_open(grid, geometry_.key_of(to_m))) return false;
  const Vec3f from_m = geometry_.nearest_inside(from_world_m).cast<float>();
  FreeFromVehicle line(grid, from_world_m, radius_m_);
  bool is_clear = true;
  bool was_open = false;
  walk_ray(geometry_, from_m, to_m.cast<float>(), [&](const Key& key) {
    if (!line.is_free(key)) return is_clear = false;
    const bool is_away = near_occupied_[geometry_.index_of(key)] == 0;
    is_clear = is_away || !was_open;
    was_open = was_open || is_away;
    return is_clear;
  });
  return is_clear;
}

}  // namespace gnbv
