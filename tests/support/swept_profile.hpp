// The profile of a structure without a flight: sweeps at even distances along its legs.
#pragma once

#include <array>
#include <vector>

#include "planner/core/belief.hpp"
#include "planner/profiling.hpp"
#include "sensors/capture.hpp"
#include "sensors/ray_scene.hpp"

namespace gnbv::test {

struct SweptProfile {
  PlannerModel model;
  Belief belief;
};

/// The poses of the first `descents` descents and the transits between, every `spacing_m`.
inline std::vector<Isometry> profile_poses(const Box3& navigation_m, const ViewPose& start,
                                           int descents, double spacing_m) {
  std::vector<Isometry> poses;
  const std::vector<ProfileLeg> legs = bounding_box_profile(navigation_m, start);
  const auto last = static_cast<std::size_t>(2 * descents);
  for (std::size_t i = 1; i < last; ++i) {
    const ViewPose& from = legs[i - 1].goal;
    const ViewPose& to = legs[i].goal;
    const double length_m = (to.p_world_m - from.p_world_m).norm();
    const double turn_rad = wrap_angle_rad(to.yaw_rad - from.yaw_rad);
    for (double s_m = 0.0; s_m < length_m; s_m += spacing_m) {
      const double t = s_m / length_m;
      poses.push_back(T_world_body(
          {from.p_world_m + t * (to.p_world_m - from.p_world_m), from.yaw_rad + t * turn_rad}));
    }
  }
  return poses;
}

/// What the planner believes after them.
inline SweptProfile sweep_profile(const World& world, const Box3& workspace_m,
                                  const ViewPose& start, int descents, double spacing_m,
                                  const LidarConfig& lidar = {}) {
  const PlannerModel model({}, {}, workspace_m, {}, {&lidar, 1});
  SweptProfile out{model, Belief(model)};
  const RayScene scene(world);
  std::vector<LidarScan> scans;
  for (const Isometry& T : profile_poses(model.navigation_m, start, descents, spacing_m)) {
    scans.push_back(capture_scan(scene, model.lidars[0], 0, {&T, 1}, 1.0, {1, scans.size()}));
  }
  Scratch scratch(model, 2);
  integrate_profile(model, scans, scratch, out.belief);
  return out;
}

}  // namespace gnbv::test
