// Many rays from one point: lists every voxel they cross once. The hot loop of map insertion.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planner/map/ray_walk.hpp"

namespace gnbv {

/// One ray of a scan in world coordinates, float32 as OctoMap's clouds. It clears the voxels from
/// the sensor up to, not including, the one with `end`; `hit` says that one holds a surface.
struct ScanRay {
  Vec3f end_world_m = Vec3f::Zero();
  bool hit = false;
};

/// A voxel of the grid: its VoxelIndex in the high half, its index in the framed grid in the low
/// one. Both are linear in the key, so one 64-bit addition moves both.
using VoxelPlace = std::int64_t;
constexpr VoxelIndex voxel_of(VoxelPlace place) { return static_cast<VoxelIndex>(place >> 32); }

/// Marks of the voxels already listed, over the grid and a frame one voxel wide around it: a ray
/// that reaches the frame has left the grid, and since it is straight it never comes back. Memory
/// of one thread, reused from scan to scan; whoever marks voxels clears them before the next scan.
class FanWalker {
 public:
  explicit FanWalker(const GridGeometry& grid);

  /// Marks the voxel; false when it was marked before. Requires grid.contains(key).
  bool mark(const Key& key) { return mark(place_of(key)); }
  bool mark(VoxelPlace place);
  void clear(std::span<const VoxelPlace> places);
  /// Requires grid.contains(key).
  VoxelPlace place_of(const Key& key) const;

  /// Appends to `places`, and marks, every unmarked voxel of the grid that OctoMap's computeRayKeys
  /// names for any of the rays. The order depends on the arguments and the marks alone.
  void walk(const RayOrigin& origin, std::span<const ScanRay> rays,
            std::vector<VoxelPlace>& places);

 private:
  struct Lanes;
  /// Walks a ray from a voxel outside the grid to its first one inside, where `ray` and `key` then
  /// stand; false when it ends before, or never comes in.
  bool enter(const Key& key_end, RaySteps& ray, Key& key) const;
  bool start_ray(const RayOrigin& origin, const Vec3f& end_m, Lanes& lanes, std::size_t lane,
                 std::vector<VoxelPlace>& places);
  bool start_next(const RayOrigin& origin, std::span<const ScanRay>& rays, Lanes& lanes,
                  std::size_t lane, std::vector<VoxelPlace>& places);
  void walk_one_by_one(const RayOrigin& origin, std::span<const ScanRay> rays,
                       std::vector<VoxelPlace>& places);

  GridGeometry grid_;
  std::array<VoxelPlace, 3> move_ = {0, 0, 0};  // change of place with a step up each axis
  VoxelPlace first_ = 0;                        // place of the voxel at min_key
  std::vector<std::uint8_t> marks_;             // of the framed grid, and one resting place
};

}  // namespace gnbv
