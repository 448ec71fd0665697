#include "planner/planner.hpp"

#include <algorithm>
#include <cmath>

#include "sim/core/error.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {
namespace {

/// Volume of the pyramids up to maximum range, in voxels.
double frustum_voxels(std::span<const CameraModel> cameras, double resolution_m) {
  double volume_m3 = 0.0;
  for (const CameraModel& camera : cameras) {
    const CameraConfig& c = camera.config;
    volume_m3 += 4.0 / 3.0 * std::tan(0.5 * c.fov_x_rad) * std::tan(0.5 * c.fov_y_rad) *
                 std::pow(c.range_max_m, 3);
  }
  return volume_m3 / std::pow(resolution_m, 3);
}

}  // namespace

PlannerModel::PlannerModel(const PlannerConfig& planner_config, const Box3& workspace,
                           std::span<const CameraModel> camera_models,
                           std::span<const LidarModel> lidar_models, std::uint64_t mission_seed)
    : config(planner_config),
      seed(mission_seed),
      workspace_m(workspace),
      navigation_m(navigation_box_m(planner_config.validity, workspace)),
      cameras(camera_models.begin(), camera_models.end()),
      lidars(lidar_models.begin(), lidar_models.end()),
      view_rays(make_view_rays(cameras, planner_config.map.resolution_m)),
      view_voxels(frustum_voxels(cameras, planner_config.map.resolution_m)),
      needs_shadow(!is_route(config.utility.name) && !is_oracle(config.utility.name) &&
                   needs_of(config.utility).shadow) {}

Belief::Belief(const PlannerModel& model)
    : grid(model.config.map, model.workspace_m),
      cloud(model.config.cloud, grid.geometry()),
      shadow(model.config.utility.shadow, grid.geometry()),
      floor_z_m(model.config.floor_z_m) {}

Workbench::Workbench(const PlannerModel& model, int thread_count)
    : threads(std::max(thread_count, 1)) {
  const GridGeometry grid(model.workspace_m, model.config.map.resolution_m);
  // one by one: copies would write pages that cost nothing yet
  const std::size_t cameras = std::max<std::size_t>(model.cameras.size(), 1);
  inserters.reserve(cameras);
  for (std::size_t i = 0; i < cameras; ++i) inserters.emplace_back(grid);
  marks.reserve(static_cast<std::size_t>(threads));
  for (int i = 0; i < threads; ++i) marks.emplace_back(grid.voxel_count());
  frontier_marks = FrontierMarks(grid.voxel_count());
}

void integrate_profile(const PlannerModel& model, std::span<const LidarScan> scans,
                       Workbench& bench, Belief& belief) {
  bench.inserters.front().insert_scans(belief.grid, scans, model.lidars, model.config.floor_z_m,
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

bool sees_surface(std::span<const LidarScan> scans, std::span<const LidarModel> lidars,
                  double floor_z_m) {
  return std::any_of(scans.begin(), scans.end(), [&](const LidarScan& scan) {
    const std::vector<ScanRay> rays =
        rays_of(scan, lidars[static_cast<std::size_t>(scan.lidar)], floor_z_m);
    return std::any_of(rays.begin(), rays.end(), [](const ScanRay& ray) { return ray.hit; });
  });
}

void integrate_view(const PlannerModel& model, std::span<const DepthFrame> frames, Workbench& bench,
                    Belief& belief) {
  if (frames.empty()) return;
  GNBV_CHECK(frames.size() <= bench.inserters.size(), "{} frames of {} cameras", frames.size(),
             bench.inserters.size());
  bench.frame_rays.resize(frames.size());
  std::vector<ScanUpdate> updates(frames.size());
  const int threads_per_frame = std::max(bench.threads / static_cast<int>(frames.size()), 1);
  parallel_for(bench.threads, frames.size(), [&](std::size_t i) {
    const CameraModel& camera = model.cameras[static_cast<std::size_t>(frames[i].camera)];
    compute_frame_rays(frames[i], camera, model.config.floor_z_m, bench.frame_rays[i]);
    updates[i] = bench.inserters[i].compute_update(bench.frame_rays[i], frames[i], camera,
                                                   threads_per_frame);
  });
  const auto update_map = [&] {
    for (std::size_t i = 0; i < frames.size(); ++i) {
      belief.grid.apply(updates[i]);
      if (model.needs_shadow) belief.shadow.add(bench.frame_rays[i], belief.grid);
    }
  };
  const auto update_cloud = [&] { belief.cloud.add(bench.frame_rays, model.config.cloud.leaf_m); };
  parallel_for(bench.threads, 2, [&](std::size_t task) {  // neither reads the other
    task == 0 ? update_map() : update_cloud();
  });
  const auto has_hit = [](const FrameRays& rays) {
    return std::find(rays.kind.begin(), rays.kind.end(), PixelRay::hits) != rays.kind.end();
  };
  belief.has_depth_return = belief.has_depth_return ||
                            std::any_of(bench.frame_rays.begin(), bench.frame_rays.end(), has_hit);
}

std::vector<Vec3> positions_of(const History& history) {
  std::vector<Vec3> positions_m;
  for (const Decision& decision : history.decisions) {
    positions_m.push_back(decision.view.p_world_m);
  }
  return positions_m;
}

void remember_entropy(const Belief& belief, double entropy_before_nat, History& history) {
  if (!belief.has_depth_return) return;
  if (history.entropies_nat.empty()) history.entropies_nat.push_back(entropy_before_nat);
  history.entropies_nat.push_back(belief.grid.total_entropy_nat());
}

}  // namespace gnbv
