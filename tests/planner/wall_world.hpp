// A wall in a small box, and what is decided before it.
#pragma once

#include <cmath>
#include <functional>

#include "planner/core/belief.hpp"
#include "planner/core/planner.hpp"
#include "planner/guided/guided_planner.hpp"
#include "planner/planners.hpp"
#include "tests/planner/map/drawn_map.hpp"

namespace gnbv {

inline const Box3 kWorkspace(Vec3(-8, -8, 0), Vec3(8, 8, 8));
inline const ViewPose kCurrent{Vec3(0.1, 0.1, 4.1), 0.0};

/// Settings, and what a planner of theirs knows of the small box.
struct SmallPlanner {
  explicit SmallPlanner(const std::function<void(PlannerConfig&)>& change = {}) {
    config.validity.collision_radius_m = 0.5;
    if (change) change(config);
  }

  PlannerConfig config;

  PlannerModel model() const {
    const CameraConfig camera;
    return make_model(config, kWorkspace, {&camera, 1}, {});
  }
  Plan plan(const Belief& belief, const History& history, int threads = 2,
            const ViewPose& current = kCurrent) const {
    const PlannerModel known = model();
    Scratch scratch(known, threads);
    return make_planner(config, known)->next(belief, history, current, scratch);
  }
};

/// A wall at x = 6, all else free where `is_known` says so and unmeasured elsewhere.
template <typename IsKnown>
Belief wall_ahead(const SmallPlanner& planner, const IsKnown& is_known) {
  Belief belief(planner.model());
  const auto is_wall = [](const Vec3& p_m) { return std::fabs(p_m.x() - 6.1) < 0.05; };
  belief.grid.apply(
      {.free = voxels_where(belief.grid,
                            [&](const Vec3& p_m) { return !is_wall(p_m) && is_known(p_m); }),
       .occupied = voxels_where(belief.grid, is_wall)});
  return belief;
}

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

/// The wall as a frontier, all else free.
inline Belief thin_wall_ahead(const SmallPlanner& planner) {
  Belief belief = wall_ahead(planner, everywhere);
  sample_thinly(belief);
  return belief;
}

/// As after five views without any change.
inline History still_history() {
  History history;
  history.entropies_nat.assign(6, 1000.0);
  return history;
}

}  // namespace gnbv
