#include "planner/planner.hpp"

#include <algorithm>
#include <cmath>

#include "planner/candidate_stats.hpp"
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

/// Candidates that may be flown to, in the order they were sampled.
std::vector<ViewPose> valid_views(const PlannerModel& model, const Belief& belief,
                                  const History& history, const ViewPose& current,
                                  std::span<const ViewPose> candidates) {
  const auto recent_count = std::min(history.decisions.size(),
                                     static_cast<std::size_t>(model.config.validity.recent_poses));
  std::vector<ViewPose> recent;
  for (auto it = history.decisions.end() - static_cast<std::ptrdiff_t>(recent_count);
       it != history.decisions.end(); ++it) {
    recent.push_back(it->view);
  }
  std::vector<ViewPose> valid;
  for (const ViewPose& candidate : candidates) {
    if (!rejection(model.config.validity, model.navigation_m, belief.grid, recent, current,
                   candidate)) {
      valid.push_back(candidate);
    }
  }
  return valid;
}

/// One ViewStats per view, each computed alone: which thread did it leaves no trace.
std::vector<ViewStats> evaluate_views(const PlannerModel& model, const Belief& belief,
                                      const ViewPose& current, std::span<const ViewPose> views,
                                      Workbench& bench) {
  std::vector<ViewStats> stats(views.size());
  const std::size_t lanes = bench.marks.size();
  parallel_for(bench.threads, lanes, [&](std::size_t lane) {
    for (std::size_t i = lane; i < views.size(); i += lanes) {
      stats[i] =
          candidate_stats(model.config.utility, belief.grid, belief.cloud, belief.shadow,
                          belief.cloud.density_max() / 3.0,  // released frontiers: 100 of 300
                          model.view_rays, views[i], bench.marks[lane]);
      stats[i].density_max = belief.cloud.density_max();
      stats[i].path_m = (views[i].p_world_m - current.p_world_m).norm();
    }
  });
  return stats;
}

/// The view with the highest utility among those sampled at one scale; the first of equals.
std::optional<Decision> best_at_scale(const PlannerModel& model, const Belief& belief,
                                      const History& history, const ViewPose& current, double scale,
                                      Workbench& bench) {
  const std::vector<ViewPose> candidates = sample_agvs(model.config.agvs, current, scale);
  const std::vector<ViewPose> valid = valid_views(model, belief, history, current, candidates);
  const std::vector<ViewStats> stats = evaluate_views(model, belief, current, valid, bench);

  std::optional<Decision> best;
  for (std::size_t i = 0; i < valid.size(); ++i) {
    const std::optional<Score> utility = score(
        model.config.utility, stats[i], {.iteration = history.decisions.size(), .candidate = i});
    if (!utility || (best && utility->value <= best->score.value)) continue;
    best = Decision{.view = valid[i],
                    .sampler = "agvs",
                    .scale = scale,
                    .candidates = static_cast<int>(candidates.size()),
                    .valid = static_cast<int>(valid.size()),
                    .score = *utility};
  }
  return best;
}

}  // namespace

PlannerModel::PlannerModel(const PlannerConfig& planner_config, const Box3& workspace,
                           std::span<const CameraModel> camera_models,
                           std::span<const LidarModel> lidar_models)
    : config(planner_config),
      workspace_m(workspace),
      navigation_m(navigation_box_m(planner_config.validity, workspace)),
      cameras(camera_models.begin(), camera_models.end()),
      lidars(lidar_models.begin(), lidar_models.end()),
      view_rays(make_view_rays(cameras, planner_config.map.resolution_m)),
      view_voxels(frustum_voxels(cameras, planner_config.map.resolution_m)) {}

Belief::Belief(const PlannerModel& model)
    : grid(model.config.map, model.workspace_m),
      cloud(model.config.cloud, grid.geometry()),
      shadow(model.config.utility.shadow, grid.geometry()) {}

Workbench::Workbench(const PlannerModel& model, int thread_count)
    : threads(std::max(thread_count, 1)),
      inserter(GridGeometry(model.workspace_m, model.config.map.resolution_m)),
      marks(static_cast<std::size_t>(threads),
            VisitMarks(
                GridGeometry(model.workspace_m, model.config.map.resolution_m).voxel_count())) {}

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
  std::vector<Vec3f> points;
  for (const DepthFrame& frame : frames) {
    const CameraModel& camera = model.cameras[static_cast<std::size_t>(frame.camera)];
    const std::vector<ScanRay> rays = rays_of(frame, camera, model.config.floor_z_m);
    const Vec3f origin_world_m = frame.T_world_camera.translation().cast<float>();
    belief.grid.apply(bench.inserter.compute_update(origin_world_m, rays, bench.threads));
    const std::vector<Vec3f> hits = surface_points_world_m(rays);
    points.insert(points.end(), hits.begin(), hits.end());
    if (needs_of(model.config.utility).shadow) {
      FrameRays columns;
      compute_frame_rays(frame, camera, model.config.floor_z_m, columns);
      belief.shadow.add(columns, belief.grid);
    }
  }
  belief.has_depth_return = belief.has_depth_return || !points.empty();
  belief.cloud.add(points, model.config.cloud.leaf_m);
}

void remember_entropy(const Belief& belief, double entropy_before_nat, History& history) {
  if (!belief.has_depth_return) return;
  if (history.entropies_nat.empty()) history.entropies_nat.push_back(entropy_before_nat);
  history.entropies_nat.push_back(belief.grid.total_entropy_nat());
}

std::optional<Decision> plan_next_view(const PlannerModel& model, const Belief& belief,
                                       const History& history, const ViewPose& current,
                                       Workbench& bench) {
  const AgvsConfig& agvs = model.config.agvs;
  Progress progress{
      .utilities = {}, .entropies_nat = history.entropies_nat, .view_voxels = model.view_voxels};
  double last_scale = 1.0;
  for (const Decision& decision : history.decisions) {
    if (decision.sampler == "start") continue;
    progress.utilities.push_back(decision.score.value);
    last_scale = decision.scale;
  }
  // a scale without any valid view is grown as at a local minimum; last comes the finest
  const double first_scale = next_agvs_scale(agvs, last_scale, progress);
  for (double scale = first_scale;; scale = std::min(scale * agvs.scale_factor, agvs.scale_max)) {
    if (auto decision = best_at_scale(model, belief, history, current, scale, bench)) {
      return decision;
    }
    if (scale >= agvs.scale_max) break;
  }
  if (first_scale <= 1.0) return std::nullopt;
  return best_at_scale(model, belief, history, current, 1.0, bench);
}

}  // namespace gnbv
