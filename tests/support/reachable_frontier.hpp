// Whether a frontier can still be reached, found out by brute force: an oracle for where missions
// end.
// For missions without no_fly boxes and gimbals.
#pragma once

#include <array>
#include <cmath>
#include <deque>
#include <optional>
#include <set>
#include <vector>

#include "planner/core/belief.hpp"
#include "planner/guided/view_sampling.hpp"
#include "planner/map/frontiers.hpp"
#include "planner/motion/free_space.hpp"
#include "planner/motion/paths.hpp"

namespace gnbv {

/// Every place of a lattice with a step of `step_m` that can be flown to from `from_m`, along its
/// lines, through voxels known to be free, the collision sphere clear and within the navigation
/// box. The first is `from_m`.
inline std::vector<Vec3> reachable_places(const PlannerModel& model, const Belief& belief,
                                          const Vec3& from_m, double step_m) {
  const double radius_m = model.validity.collision_radius_m;
  using Node = std::array<int, 3>;
  std::set<Node> known = {{0, 0, 0}};
  std::deque<Node> open = {{0, 0, 0}};
  std::vector<Vec3> places;
  const auto place_m = [&](const Node& n) -> Vec3 {
    return from_m + step_m * Vec3(n[0], n[1], n[2]);
  };
  while (!open.empty()) {
    const Node node = open.front();
    open.pop_front();
    places.push_back(place_m(node));
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const int way : {-1, 1}) {
        Node next = node;
        next[axis] += way;
        const Vec3 to_m = place_m(next);
        if (known.contains(next) || !model.navigation_m.contains(to_m) ||
            !is_line_free(belief.grid, places.back(), to_m) ||
            !is_sphere_clear(belief.grid, to_m, radius_m) ||
            !is_path_clear(belief.grid, places.back(), to_m, radius_m)) {
          continue;
        }
        known.insert(next);
        open.push_back(next);
      }
  }
  return places;
}

/// A view of a frontier from one of these places that was not taken yet, looking straight at the
/// frontier's centroid; nothing where there is none.
inline std::optional<ViewPose> view_of_a_frontier(const PlannerModel& model,
                                                  const FrontierConfig& config,
                                                  const Belief& belief,
                                                  const std::vector<Vec3>& places_m,
                                                  const std::vector<ViewPose>& taken) {
  FrontierMarks marks(belief.grid.geometry().voxel_count());
  const ValidityConfig& validity = model.validity;
  const auto is_taken = [&](const ViewPose& view) {
    for (const ViewPose& t : taken) {
      const double turn_rad = std::abs(wrap_angle_rad(t.yaw_rad - view.yaw_rad));
      if ((t.p_world_m - view.p_world_m).norm() < validity.recent_distance_m &&
          turn_rad < validity.recent_yaw_rad)
        return true;
    }
    return false;
  };
  for (const FrontierCluster& cluster : find_frontiers(config, belief.grid, belief.cloud, marks))
    for (const Vec3& p_m : places_m) {
      const Vec3 to_m = cluster.centroid_world_m - p_m;
      const ViewPose view = {p_m, std::atan2(to_m.y(), to_m.x())};
      if (!is_taken(view) && !cluster_rejection(model.cameras, belief.grid, cluster, view, true))
        return view;
    }
  return std::nullopt;
}

}  // namespace gnbv
