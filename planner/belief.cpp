#include "planner/belief.hpp"

#include <algorithm>

#include "planner/model.hpp"
#include "planner/workbench.hpp"
#include "sim/core/error.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {

Belief::Belief(const PlannerModel& model)
    : grid(model.config.map, model.workspace_m),
      cloud(model.config.cloud, grid.geometry()),
      shadow(model.config.utility.shadow, grid.geometry()),
      floor_z_m(model.config.floor_z_m) {}

void integrate_profile(const PlannerModel& model, std::span<const LidarScan> scans,
                       Workbench& bench, Belief& belief) {
  bench.inserter.insert_scans(belief.grid, scans, model.lidars, model.config.floor_z_m,
                              bench.threads);
  std::vector<Vec3f> points;
  for (const LidarScan& scan : scans) {
    const LidarModel& lidar = model.lidars[static_cast<std::size_t>(scan.lidar)];
    const std::vector<Vec3f> hits =
        surface_points_world_m(rays_of(scan, lidar, model.config.floor_z_m));
    points.insert(points.end(), hits.begin(), hits.end());
  }
  belief.cloud.add(points, model.config.cloud.profile_leaf_m);
}

void integrate_view(const PlannerModel& model, std::span<const DepthFrame> frames, Workbench& bench,
                    Belief& belief) {
  if (frames.empty()) return;
  bench.frame_rays.resize(frames.size());
  const auto camera_of = [&](std::size_t i) -> const CameraModel& {
    return model.cameras[static_cast<std::size_t>(frames[i].camera)];
  };
  parallel_for(bench.threads, frames.size(), [&](std::size_t i) {
    compute_frame_rays(frames[i], camera_of(i), model.config.floor_z_m, bench.frame_rays[i]);
  });
  const auto add_to_map = [&](std::size_t i) {
    belief.grid.apply(bench.inserter.compute_update(bench.frame_rays[i], frames[i], camera_of(i),
                                                    belief.grid, bench.threads));
    if (model.needs_shadow) belief.shadow.add(bench.frame_rays[i], belief.grid);
  };
  // the cloud, which nothing here reads, grows beside the map
  parallel_for(bench.threads, 2, [&](std::size_t task) {
    if (task == 0) belief.cloud.add(bench.frame_rays, model.config.cloud.leaf_m);
    for (std::size_t i = 0; task == 1 && i < frames.size(); ++i) add_to_map(i);
  });
  const auto has_hit = [](const FrameRays& rays) {
    return std::find(rays.kind.begin(), rays.kind.end(), PixelRay::hits) != rays.kind.end();
  };
  belief.has_depth_return = belief.has_depth_return ||
                            std::any_of(bench.frame_rays.begin(), bench.frame_rays.end(), has_hit);
}

}  // namespace gnbv
