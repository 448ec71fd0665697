// Many rays from one point: lists every voxel they cross once. The hot loop of map insertion.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planner/map/occupancy_grid.hpp"
#include "planner/map/ray_walk.hpp"

namespace gnbv {

/// One ray of a scan in world coordinates, float32 as OctoMap's clouds. It clears the voxels from
/// the sensor up to, not including, the one with `end`; `hit` says that one holds a surface.
struct ScanRay {
  Vec3f end_world_m = Vec3f::Zero();
  bool hit = false;
};

/// Lists what the rays of a scan touch. Memory of one thread, reused from scan to scan: marks of
/// the voxels already listed, over the grid and a frame one voxel wide around it: a ray that
/// reaches the frame has left the grid, and since it is straight it never comes back.
class FanWalker {
 public:
  explicit FanWalker(const GridGeometry& grid);

  /// The voxels the rays touch inside the grid. Oracle: octomap::OcTree::computeUpdate, whose
  /// computeRayKeys names the free ones. Points must be finite.
  ScanUpdate compute_update(const Vec3f& origin_world_m, std::span<const ScanRay> rays);

 private:
  /// A voxel of the grid: its VoxelIndex in the high half, its index in the framed grid in the low
  /// one. Both are linear in the key, so one 64-bit addition moves both.
  using Place = std::int64_t;
  struct Rays;

  /// Requires grid.contains(key).
  Place place_of(const Key& key) const;
  /// Appends the voxel to the list unless it is marked, and marks it.
  void list(Place place, std::vector<Place>& places);
  /// Takes the marks away.
  std::vector<VoxelIndex> take(const std::vector<Place>& places);
  /// Lists in free_ every voxel of the grid that computeRayKeys names for any of the rays.
  void walk(const RayOrigin& origin, std::span<const ScanRay> rays);
  /// Walks a ray from a voxel outside the grid to its first one inside, where `ray` and `key` then
  /// stand; false when it ends before, or never comes in.
  bool enter(const Key& key_end, RaySteps& ray, Key& key) const;
  bool start_ray(const RayOrigin& origin, const Vec3f& end_m, Rays& under_way, std::size_t which);
  bool start_next(const RayOrigin& origin, std::span<const ScanRay>& rays, Rays& under_way,
                  std::size_t which);

  GridGeometry grid_;
  std::array<Place, 3> move_ = {0, 0, 0};  // change of place with a step up each axis
  Place first_ = 0;                        // place of the voxel at min_key
  std::vector<std::uint8_t> marks_;        // of the framed grid, and one resting place
  std::vector<Place> occupied_, free_;     // of the scan at hand
};

}  // namespace gnbv
