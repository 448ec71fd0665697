#include "tools/mission/start_pose.hpp"

#include <algorithm>
#include <cmath>

#include "bench/limits/legal_viewpoints.hpp"
#include "bench/score/escape_search.hpp"
#include "planner/motion/config.hpp"
#include "planner/profiling.hpp"
#include "sim/core/error.hpp"
#include "sim/core/rng.hpp"
#include "sim/flight/flight.hpp"

namespace gnbv {
namespace {

bool is_surrounded(const Scenario& scenario) {
  return !scenario.obstacles.empty() || !scenario.no_fly.empty() || !scenario.terrain.path.empty();
}

}  // namespace

ViewPose start_pose(const Scenario& scenario, const RayScene& scene) {
  const StartConfig& start = scenario.start;
  const Box3 box = navigation_box_m(scenario.planner.validity, scenario.workspace_m);
  const double radius_m = scenario.planner.validity.collision_radius_m;
  const NoFly no_fly = no_fly_of(scenario);
  constexpr std::uint64_t kTries = 100;
  for (std::uint64_t attempt = 0; attempt < kTries; ++attempt) {
    const auto offset = [&](std::uint64_t axis) {
      return 2.0 * uniform01({scenario.seed, Stream::start_pose, attempt, axis}) - 1.0;
    };
    ViewPose pose = start.pose;
    if (const auto gimbal = gimbal_of(scenario.cameras)) {
      pose.gimbal_pitch_rad = nearest_pitch_rad(*gimbal, 0.0);
    }
    pose.p_world_m += start.jitter_m.cwiseProduct(Vec3(offset(0), offset(1), offset(2)));
    pose.p_world_m = pose.p_world_m.cwiseMax(box.min()).cwiseMin(box.max());
    pose.yaw_rad = wrap_angle_rad(pose.yaw_rad + start.jitter_yaw_rad * offset(3));
    if (!no_fly.allows(pose.p_world_m)) continue;
    if (scene.clearance_m(pose.p_world_m, radius_m) >= radius_m) return pose;
  }
  const bool is_structure =
      scene.distance_to_structure_m(start.pose.p_world_m, radius_m) < radius_m;
  throw BadInput(
      "start.position_m: [{}, {}, {}] and its jitter lie within "
      "planner.validity.collision_radius_m = {} of {}: move the start away from it",
      start.pose.p_world_m.x(), start.pose.p_world_m.y(), start.pose.p_world_m.z(), radius_m,
      is_structure || !is_surrounded(scenario) ? "the structure"
                                               : "an obstacle, the terrain or a no_fly box");
}

std::string moved_start_note(const Scenario& scenario, const ViewPose& start) {
  const ViewPose& asked = scenario.start.pose;
  if (start.p_world_m == asked.p_world_m && start.yaw_rad == wrap_angle_rad(asked.yaw_rad)) {
    return "";
  }
  const auto text = [](const ViewPose& pose) {
    const Vec3& p_m = pose.p_world_m;
    return fmt::format("[{:.2f}, {:.2f}, {:.2f}], yaw {:.1f} deg", p_m.x(), p_m.y(), p_m.z(),
                       rad_to_deg(pose.yaw_rad));
  };
  return fmt::format("start: {}: seed {} moved it by start.jitter_m and jitter_yaw_deg from {}",
                     text(start), scenario.seed, text(asked));
}

void need_way_out(const Scenario& scenario, const RayScene& scene, const Box3& structure_m,
                  const ViewPose& start, int threads) {
  const ProfilingMethod profiling = scenario.planner.profiling.method;
  const bool is_flown =
      profiling == ProfilingMethod::bounding_box || profiling == ProfilingMethod::circular;
  const Box3 box = navigation_box_m(scenario.planner.validity, scenario.workspace_m);
  if (!is_flown || structure_m.contains(box) || !structure_m.contains(start.p_world_m)) return;
  const double radius_m = scenario.planner.validity.collision_radius_m;
  const NoFly no_fly = no_fly_of(scenario);
  const auto is_way_out = [&](const Vec3& direction) {
    const double length_m = structure_m.diagonal().norm();
    for (double t = 0.05; t <= 1.0; t += 0.05) {
      const Vec3 end_m = start.p_world_m + t * length_m * direction;
      if (!box.contains(end_m)) return false;
      if (!structure_m.contains(end_m)) {
        return no_fly.allows_leg(start.p_world_m, end_m) &&
               is_leg_clear(scene, start.p_world_m, end_m, radius_m);
      }
    }
    return false;
  };
  for (const Vec3f& direction : spread_directions(64)) {
    if (is_way_out(direction.cast<double>())) return;
  }
  const LegalViewpoints legal = find_legal_viewpoints(scenario, scene, start, threads);
  if (std::any_of(legal.p_world_m.begin(), legal.p_world_m.end(),
                  [&](const Vec3& p_m) { return !structure_m.contains(p_m); })) {
    return;
  }
  throw BadInput(
      "start.position_m: the start [{:.2f}, {:.2f}, {:.2f}] is enclosed by the structure: no way "
      "out was found for a sphere of planner.validity.collision_radius_m = {}, and the profile is "
      "flown outside; move the start, try `--bounds auto`, or set planner.profiling.method: none",
      start.p_world_m.x(), start.p_world_m.y(), start.p_world_m.z(), radius_m);
}

void need_way_up(const Scenario& scenario, const World& world, const RayScene& scene,
                 const ViewPose& start) {
  if (!scenario.start.on_ground) return;
  const double radius_m = scenario.planner.validity.collision_radius_m;
  Vec3 low_m = start.p_world_m;
  low_m.z() = ground_height_m(world, start.p_world_m) + 1.5 * radius_m;  // slopes are near, too
  if (std::isinf(low_m.z())) {
    throw BadInput(
        "start.on_ground: there is no ground below [{:.2f}, {:.2f}, {:.2f}], where the mission "
        "begins; structure.ground: true, or a terrain, gives one",
        start.p_world_m.x(), start.p_world_m.y(), start.p_world_m.z());
  }
  if (low_m.z() >= start.p_world_m.z() || is_leg_clear(scene, low_m, start.p_world_m, radius_m)) {
    return;
  }
  throw BadInput(
      "start.on_ground: the way up to [{:.2f}, {:.2f}, {:.2f}] comes nearer than "
      "planner.validity.collision_radius_m = {} m to something solid: move start.position_m",
      start.p_world_m.x(), start.p_world_m.y(), start.p_world_m.z(), radius_m);
}

std::string profile_warning(const Scenario& scenario, const RayScene& scene,
                            const ViewPose& start) {
  const ProfilingConfig& profiling = scenario.planner.profiling;
  if (scenario.vehicle.kind == VehicleKind::ideal || profiling.method == ProfilingMethod::saved) {
    return "";
  }
  const Box3 box_m = navigation_box_m(scenario.planner.validity, scenario.workspace_m);
  ProfileRoute route(profiling, box_m, start, no_fly_of(scenario));
  Vec3 at_m = start.p_world_m;
  while (const auto leg = route.next(true)) {
    const Vec3& to_m = leg->goal.p_world_m;
    const double hull_m = scenario.vehicle.airframe.hull_radius_m;
    if (!is_leg_clear(scene, at_m, to_m, hull_m)) {
      return fmt::format(
          "the profile's leg from [{:.2f}, {:.2f}, {:.2f}] to [{:.2f}, {:.2f}, {:.2f}] comes "
          "nearer than the hull's {} m to something solid: the mission may end there as collision; "
          "workspace_m, no_fly, start.position_m or planner.profiling.method lead it elsewhere",
          at_m.x(), at_m.y(), at_m.z(), to_m.x(), to_m.y(), to_m.z(), hull_m);
    }
    at_m = to_m;
  }
  return "";
}

}  // namespace gnbv
