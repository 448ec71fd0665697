#include "planner/core/belief.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sensors/sights.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {

PlannerModel::PlannerModel(const BeliefConfig& belief_config, const ValidityConfig& validity_config,
                           const Box3& workspace, std::span<const CameraConfig> camera_configs,
                           std::span<const LidarConfig> lidar_configs, std::uint64_t mission_seed,
                           NoFly mission_no_fly)
    : belief(belief_config),
      validity(validity_config),
      validity_around(validity_config),
      seed(mission_seed),
      workspace_m(workspace),
      navigation_m(navigation_box_m(validity_config, workspace)),
      no_fly(std::move(mission_no_fly)),
      gimbal(gimbal_of(camera_configs)),
      pitches_rad(gimbal ? gnbv::pitches_rad(*gimbal) : std::vector<double>{0.0}) {
  if (validity.path == PathCheck::straight) validity_around.path = PathCheck::astar;
  const double resolution_m = belief.map.resolution_m;
  for (const CameraConfig& camera : camera_configs) cameras.push_back(make_camera_model(camera));
  std::size_t sights_so_far = cameras.size();
  for (const LidarConfig& lidar : lidar_configs) {
    lidars.push_back(make_lidar_model(lidar));
    first_sector.push_back(sights_so_far);
    if (looks_at_views(lidar, !camera_configs.empty())) {
      sights_so_far += sectors_of(lidar, lidar.range_max_m).size();
    }
  }
  first_sector.push_back(sights_so_far);
  for (const CameraConfig& sight : sights_of(camera_configs, lidar_configs, workspace)) {
    sights.push_back(make_camera_model(sight));
    view_voxels += frustum_m3(sight);
  }
  for (const double pitch_rad : pitches_rad) {
    view_rays.push_back(make_view_rays(turned(sights, pitch_rad), resolution_m));
  }
  view_voxels /= std::pow(resolution_m, 3);
}

const ViewRays& PlannerModel::rays_at(double gimbal_pitch_rad) const {
  const auto nearest =
      std::min_element(pitches_rad.begin(), pitches_rad.end(), [&](double a, double b) {
        return std::abs(a - gimbal_pitch_rad) < std::abs(b - gimbal_pitch_rad);
      });
  return view_rays[static_cast<std::size_t>(nearest - pitches_rad.begin())];
}

bool PlannerModel::can_pitch(double gimbal_pitch_rad) const {
  constexpr double kRounding_rad = 1e-9;
  if (!gimbal) return gimbal_pitch_rad == 0.0;
  return gimbal_pitch_rad >= gimbal->min_rad - kRounding_rad &&
         gimbal_pitch_rad <= gimbal->max_rad + kRounding_rad;
}

Belief::Belief(const PlannerModel& model)
    : grid(model.belief.map, model.workspace_m, model.belief.object_bounds_m),
      cloud(model.belief.cloud, grid.geometry()),
      ranged({.leaf_m = model.belief.cloud.profile_leaf_m}, grid.geometry()),
      shadow(model.belief.shadow, grid.geometry()),
      floor_z_m(model.belief.floor_z_m) {}

Scratch::Scratch(const PlannerModel& model, int thread_count)
    : threads(std::max(thread_count, 1)), inserter(model.geometry()) {
  const std::size_t voxels = model.geometry().voxel_count();
  // one by one: copies would write pages that cost nothing yet
  marks.reserve(static_cast<std::size_t>(threads));
  for (int i = 0; i < threads; ++i) marks.emplace_back(voxels);
  frontier_marks = FrontierMarks(voxels);
}

namespace {

/// Adds the sweeps to the map; what they hit.
std::vector<Vec3f> insert_scans(const PlannerModel& model, std::span<const LidarScan> scans,
                                Scratch& scratch, Belief& belief) {
  const double floor_z_m = model.belief.floor_z_m;
  scratch.inserter.insert_scans(belief.grid, scans, model.lidars, floor_z_m, scratch.threads);
  std::vector<Vec3f> points;
  for (const LidarScan& scan : scans) {
    const LidarModel& lidar = model.lidars[static_cast<std::size_t>(scan.lidar)];
    const std::vector<Vec3f> hits = surface_points_world_m(rays_of(scan, lidar, floor_z_m));
    points.insert(points.end(), hits.begin(), hits.end());
  }
  return points;
}

}  // namespace

void integrate_profile(const PlannerModel& model, std::span<const LidarScan> scans,
                       Scratch& scratch, Belief& belief) {
  belief.cloud.add(insert_scans(model, scans, scratch, belief), model.belief.cloud.profile_leaf_m);
}

void integrate_sweeps(const PlannerModel& model, std::span<const LidarScan> scans, Scratch& scratch,
                      Belief& belief) {
  if (scans.empty()) return;
  belief.ranged.add(insert_scans(model, scans, scratch, belief), model.belief.cloud.profile_leaf_m);
}

void integrate_looks(const PlannerModel& model, std::span<const LidarScan> scans, Scratch& scratch,
                     Belief& belief) {
  scratch.frame_rays.resize(1);
  FrameRays& rays = scratch.frame_rays.front();
  for (const LidarScan& scan : scans) {
    const auto lidar = static_cast<std::size_t>(scan.lidar);
    const Isometry T_world_body = scan.T_world_lidar * model.lidars[lidar].T_body_lidar.inverse();
    for (std::size_t i = model.first_sector[lidar]; i < model.first_sector[lidar + 1]; ++i) {
      belief.frame_poses.push_back(
          {static_cast<int>(i), T_world_body * model.sights[i].T_body_camera});
    }
    compute_sweep_rays(scan, model.lidars[lidar], model.belief.floor_z_m, rays,
                       model.belief.map.no_return);
    belief.grid.apply(scratch.inserter.compute_update(rays));
    if (model.belief.keeps_shadow) belief.shadow.add(rays, belief.grid);
    std::vector<Vec3f> hits;
    for (std::size_t i = 0; i < rays.kind.size(); ++i) {
      if (rays.kind[i] == PixelRay::hits) hits.push_back(rays.end_world_m(i));
    }
    belief.cloud.add(hits, belief.cloud.config().leaf_m);
    belief.has_depth_return |= !hits.empty();
  }
}

void integrate_view(const PlannerModel& model, std::span<const DepthFrame> frames, Scratch& scratch,
                    Belief& belief) {
  if (frames.empty()) return;
  for (const DepthFrame& frame : frames) {
    belief.frame_poses.push_back({frame.camera, frame.T_world_camera});
  }
  std::vector<FrameRays>& rays = scratch.frame_rays;
  rays.resize(frames.size());
  const auto camera_of = [&](std::size_t i) -> const CameraModel& {
    return model.cameras[static_cast<std::size_t>(frames[i].camera)];
  };
  parallel_for(scratch.threads, frames.size(), [&](std::size_t i) {
    compute_frame_rays(frames[i], camera_of(i), model.belief.floor_z_m, rays[i],
                       model.belief.map.no_return);
  });
  const auto add_to_map = [&](std::size_t i) {
    belief.grid.apply(scratch.inserter.compute_update(rays[i], frames[i], camera_of(i), belief.grid,
                                                      scratch.threads));
    if (model.belief.keeps_shadow) belief.shadow.add(rays[i], belief.grid);
  };
  // the cloud, which nothing here reads, grows beside the map
  parallel_for(scratch.threads, 2, [&](std::size_t task) {
    if (task == 0) belief.cloud.add(rays);
    for (std::size_t i = 0; task == 1 && i < frames.size(); ++i) add_to_map(i);
  });
  belief.has_depth_return |= std::any_of(rays.begin(), rays.end(), [](const FrameRays& frame) {
    return std::find(frame.kind.begin(), frame.kind.end(), PixelRay::hits) != frame.kind.end();
  });
}

}  // namespace gnbv
