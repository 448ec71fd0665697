// A wall in a small box, and what is decided before it.
#pragma once

#include <cmath>
#include <functional>

#include "planner/belief.hpp"
#include "planner/history.hpp"
#include "planner/model.hpp"
#include "planner/next_view.hpp"
#include "planner/workbench.hpp"

namespace gnbv {

inline const Box3 kWorkspace(Vec3(-8, -8, 0), Vec3(8, 8, 8));
inline const ViewPose kCurrent{Vec3(0.1, 0.1, 4.1), 0.0};

inline PlannerModel small_model() {
  PlannerConfig config;
  config.validity.collision_radius_m = 0.5;
  const CameraModel camera = make_camera_model({});
  return PlannerModel(config, kWorkspace, {&camera, 1}, {});
}

/// A wall at x = 6, all else free where `is_known` says so and unmeasured elsewhere.
template <typename IsKnown>
Belief wall_ahead(const PlannerModel& model, const IsKnown& is_known) {
  Belief belief(model);
  const GridGeometry& grid = belief.grid.geometry();
  ScanUpdate update;
  for (VoxelIndex v = 0; v < grid.voxel_count(); ++v) {
    const Vec3 center_m = grid.center_m(grid.key_at(v));
    if (std::fabs(center_m.x() - 6.1) < 0.05) {
      update.occupied.push_back(v);
    } else if (is_known(center_m)) {
      update.free.push_back(v);
    }
  }
  belief.grid.apply(update);
  return belief;
}

inline bool everywhere(const Vec3&) { return true; }

/// The wall of `wall_ahead`, seen as a few points a voxel: all of it a frontier.
inline void sample_thinly(Belief& belief) {
  std::vector<Vec3f> points_m;
  const GridGeometry& grid = belief.grid.geometry();
  for (VoxelIndex v = 0; v < grid.voxel_count(); ++v) {
    if (belief.grid.state(v) != VoxelState::occupied) continue;
    points_m.push_back(grid.center_m(grid.key_at(v)).cast<float>());
  }
  belief.cloud.add(points_m, 0.02);
}

/// As after five views without any change.
inline History still_history() {
  History history;
  history.entropies_nat.assign(6, 1000.0);
  return history;
}

inline Plan full_plan(const PlannerModel& model, const Belief& belief, const History& history) {
  Workbench bench(model, 2);
  return plan_next_view(model, belief, history, kCurrent, bench);
}

inline PlannerModel model_with(const std::function<void(PlannerConfig&)>& change) {
  PlannerConfig config;
  config.validity.collision_radius_m = 0.5;
  change(config);
  const CameraModel camera = make_camera_model({});
  return PlannerModel(config, kWorkspace, {&camera, 1}, {});
}

}  // namespace gnbv
