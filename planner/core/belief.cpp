#include "planner/core/belief.hpp"

#include <algorithm>

#include "planner/core/model.hpp"
#include "planner/core/scratch.hpp"
#include "sim/core/error.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {

Belief::Belief(const PlannerModel& model)
    : grid(model.belief.map, model.workspace_m),
      cloud(model.belief.cloud, grid.geometry()),
      shadow(model.belief.shadow, grid.geometry()),
      floor_z_m(model.belief.floor_z_m) {}

void integrate_profile(const PlannerModel& model, std::span<const LidarScan> scans,
                       Scratch& scratch, Belief& belief) {
  scratch.inserter.insert_scans(belief.grid, scans, model.lidars, model.belief.floor_z_m,
                                scratch.threads);
  std::vector<Vec3f> points;
  for (const LidarScan& scan : scans) {
    const LidarModel& lidar = model.lidars[static_cast<std::size_t>(scan.lidar)];
    const std::vector<Vec3f> hits =
        surface_points_world_m(rays_of(scan, lidar, model.belief.floor_z_m));
    points.insert(points.end(), hits.begin(), hits.end());
  }
  belief.cloud.add(points, model.belief.cloud.profile_leaf_m);
}

void integrate_view(const PlannerModel& model, std::span<const DepthFrame> frames, Scratch& scratch,
                    Belief& belief) {
  if (frames.empty()) return;
  scratch.frame_rays.resize(frames.size());
  const auto camera_of = [&](std::size_t i) -> const CameraModel& {
    return model.cameras[static_cast<std::size_t>(frames[i].camera)];
  };
  parallel_for(scratch.threads, frames.size(), [&](std::size_t i) {
    compute_frame_rays(frames[i], camera_of(i), model.belief.floor_z_m, scratch.frame_rays[i]);
  });
  const auto add_to_map = [&](std::size_t i) {
    belief.grid.apply(scratch.inserter.compute_update(scratch.frame_rays[i], frames[i],
                                                      camera_of(i), belief.grid, scratch.threads));
    if (model.belief.keeps_shadow) belief.shadow.add(scratch.frame_rays[i], belief.grid);
  };
  // the cloud, which nothing here reads, grows beside the map
  parallel_for(scratch.threads, 2, [&](std::size_t task) {
    if (task == 0) belief.cloud.add(scratch.frame_rays);
    for (std::size_t i = 0; task == 1 && i < frames.size(); ++i) add_to_map(i);
  });
  const auto has_hit = [](const FrameRays& rays) {
    return std::find(rays.kind.begin(), rays.kind.end(), PixelRay::hits) != rays.kind.end();
  };
  belief.has_depth_return =
      belief.has_depth_return ||
      std::any_of(scratch.frame_rays.begin(), scratch.frame_rays.end(), has_hit);
}

}  // namespace gnbv
