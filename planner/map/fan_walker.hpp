// Many rays from one point: lists every voxel they cross once. The hot loop of map insertion.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planner/map/fan_kernels.hpp"
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
  /// computeRayKeys names the free ones. Points must be finite. The lists go into the memory of
  /// `update`, whatever it holds.
  ScanUpdate compute_update(const Vec3f& origin_world_m, std::span<const ScanRay> rays,
                            ScanUpdate update = {});

 private:
  /// A voxel's index in the framed grid; linear in the key.
  using Place = std::int32_t;

  /// Requires grid.contains(key).
  Place place_of(const Key& key) const;
  VoxelIndex voxel_at(Place place) const;
  /// Appends the voxel to listed_ unless it is marked, and marks it.
  void list(Place place);
  /// Takes those listed from number `first` on, and their marks, away.
  void take(std::size_t first, std::vector<VoxelIndex>& voxels);
  /// Lists every voxel of the grid that computeRayKeys names for any of the rays.
  void walk(const RayOrigin& origin, std::span<const ScanRay> rays);
  /// Takes a ray from a voxel outside the grid to its first one inside; false when it ends before,
  /// or never comes in.
  bool enter(RaySteps& ray) const;
  /// Lists where the ray begins and puts it into the bundle; false when it goes no further.
  bool start_ray(const RayOrigin& origin, const Vec3f& end_m, std::size_t which);

  GridGeometry grid_;
  std::array<Place, 3> move_ = {0, 0, 0};  // change of place with a step up each axis
  Place first_ = 0;                        // place of the voxel at min_key
  double layers_per_place_ = 0.0, rows_per_place_ = 0.0;  // 1 over move_[2] and move_[1]
  std::vector<std::uint8_t> marks_;  // of the framed grid, and one resting place
  std::size_t steps_max_ = 0;        // of one ray inside the grid
  std::vector<Place> listed_;        // of the scan at hand, the first listed_count_ of them
  std::size_t listed_count_ = 0;
  FanRays bundle_{};
};

}  // namespace gnbv
