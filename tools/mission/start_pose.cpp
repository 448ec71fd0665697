#include "tools/mission/start_pose.hpp"

#include "planner/view_validity.hpp"
#include "sim/core/error.hpp"
#include "sim/core/rng.hpp"

namespace gnbv {

ViewPose start_pose(const Scenario& scenario, const RayScene& scene) {
  const StartConfig& start = scenario.start;
  const Box3 box = navigation_box_m(scenario.planner.validity, scenario.workspace_m);
  const double radius_m = scenario.planner.validity.collision_radius_m;
  constexpr std::uint64_t kTries = 100;
  for (std::uint64_t attempt = 0; attempt < kTries; ++attempt) {
    const auto offset = [&](std::uint64_t axis) {
      return 2.0 * uniform01({scenario.seed, Stream::start_pose, attempt, axis}) - 1.0;
    };
    ViewPose pose = start.pose;
    pose.p_world_m += start.jitter_m.cwiseProduct(Vec3(offset(0), offset(1), offset(2)));
    pose.p_world_m = pose.p_world_m.cwiseMax(box.min()).cwiseMin(box.max());
    pose.yaw_rad = wrap_angle_rad(pose.yaw_rad + start.jitter_yaw_rad * offset(3));
    if (scene.distance_to_structure_m(pose.p_world_m, radius_m) >= radius_m) return pose;
  }
  throw BadInput(fmt::format(
      "start.position_m: [{}, {}, {}] and its jitter lie within planner.validity."
      "collision_radius_m = {} of the structure: move the start away from it",
      start.pose.p_world_m.x(), start.pose.p_world_m.y(), start.pose.p_world_m.z(), radius_m));
}

}  // namespace gnbv
