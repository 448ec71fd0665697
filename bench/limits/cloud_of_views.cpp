#include "bench/limits/cloud_of_views.hpp"

#include <algorithm>

#include "sensors/capture.hpp"
#include "sim/core/error.hpp"

namespace gnbv {
std::vector<std::uint32_t> found_voxels(const VoxelSet& reference,
                                        std::span<const Vec3f> points_world_m) {
  std::vector<std::uint32_t> indices;
  auto from = reference.begin();
  for (const std::uint64_t code : covered_voxels(points_world_m, 0)) {
    from = std::lower_bound(from, reference.end(), code);
    if (from == reference.end()) break;
    if (*from == code) indices.push_back(static_cast<std::uint32_t>(from - reference.begin()));
  }
  return indices;
}

std::vector<CameraModel> exact_cameras(const Scenario& scenario) {
  std::vector<CameraModel> cameras;
  for (CameraConfig config : sights_of(scenario)) {
    config.noise.model = DepthNoise::none;
    cameras.push_back(make_camera_model(config));
  }
  return cameras;
}

void take_view(const RayScene& scene, std::span<const CameraModel> cameras, const ViewPose& view,
               double floor_z_m, int threads, std::vector<FrameRays>& rays) {
  rays.resize(cameras.size());
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const DepthFrame frame = capture_depth(scene, turned(cameras[i], view.gimbal_pitch_rad),
                                           static_cast<int>(i), T_world_body(view), {}, threads);
    compute_frame_rays(frame, cameras[i], floor_z_m, rays[i]);
  }
}

std::vector<std::uint32_t> finds_alone(const VoxelSet& reference, std::span<const FrameRays> view,
                                       double leaf_m) {
  const LeafLattice lattice(leaf_m);
  LeafSums sums;
  for (const FrameRays& frame : view) {
    for (std::size_t i = 0; i < frame.kind.size(); ++i) {
      if (frame.kind[i] != PixelRay::hits) continue;
      const Vec3f p_m = frame.end_world_m(i);
      sums.add(lattice.key_of(p_m), p_m);
    }
  }
  return found_voxels(reference, sums.centroids_m());
}

CloudOfViews::CloudOfViews(const Scenario& scenario, const VoxelSet& reference,
                           std::span<const Vec3f> held_world_m)
    : reference_(reference),
      cloud_(scenario.planner.cloud,
             GridGeometry(scenario.workspace_m, scenario.planner.map.resolution_m)),
      is_found_(reference.size(), 0) {
  GNBV_CHECK(cloud_.restore(held_world_m), "two of the points lie in one leaf");
  find(held_world_m);
}

void CloudOfViews::add(std::span<const FrameRays> view) {
  const std::size_t gained = cloud_.add(view);
  find(cloud_.points_world_m().last(gained));
}

void CloudOfViews::find(std::span<const Vec3f> points_world_m) {
  for (const std::uint32_t voxel : found_voxels(reference_, points_world_m)) {
    found_ += is_found_[voxel] == 0 ? 1 : 0;
    is_found_[voxel] = 1;
  }
}

}  // namespace gnbv
