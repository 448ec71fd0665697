// What a mission's cloud would hold after given views, flown without any error.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bench/score/voxel_set.hpp"
#include "planner/map/surface_cloud.hpp"
#include "scenarios/scenario.hpp"
#include "sensors/ray_scene.hpp"

namespace gnbv {

/// What looks at the scenario's views (sensors/sights.hpp), without noise.
std::vector<CameraModel> exact_cameras(const Scenario& scenario);

/// One view by all cameras, as rays in the world.
void take_view(const RayScene& scene, std::span<const CameraModel> cameras, const ViewPose& view,
               double floor_z_m, int threads, std::vector<FrameRays>& rays);

/// Ascending: which voxels of `reference`, by index, a cloud of this view alone would cover
/// after the leaf filter.
std::vector<std::uint32_t> finds_alone(const VoxelSet& reference, std::span<const FrameRays> view,
                                       double leaf_m);

/// Ascending: which voxels of `reference`, by index, any of the points covers.
std::vector<std::uint32_t> found_voxels(const VoxelSet& reference,
                                        std::span<const Vec3f> points_world_m);

/// The mission's own cloud (SurfaceCloud, with its leaf filter), and which voxels of `reference` it
/// covers.
class CloudOfViews {
 public:
  /// Begins with the points of such a cloud. Keeps a reference to the voxels.
  CloudOfViews(const Scenario& scenario, const VoxelSet& reference,
               std::span<const Vec3f> held_world_m = {});

  void add(std::span<const FrameRays> view);

  const SurfaceCloud& cloud() const { return cloud_; }
  /// How many voxels of the reference it covers.
  std::size_t found() const { return found_; }

 private:
  void find(std::span<const Vec3f> points_world_m);

  const VoxelSet& reference_;
  SurfaceCloud cloud_;
  std::vector<std::uint8_t> is_found_;  // 1 for each voxel of the reference that it covers
  std::size_t found_ = 0;
};

}  // namespace gnbv
