// Which candidate views may be flown to, and how (paper section 2.4 and 3, Fig. 7).
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "planner/map/config.hpp"
#include "sim/core/pose.hpp"

namespace gnbv {

struct Candidate;
struct NoFly;
class OccupancyGrid;

/// How the way to a view is checked: straight against the map, which holds the profile (the
/// paper); straight, or else around what blocks it (ours); or not at all (released code).
enum class PathCheck { straight, astar, unchecked };

/// Defaults: section 3.1.1, and the released configuration where the paper is silent.
struct ValidityConfig {
  double collision_radius_m = 1.5;
  double z_min_m = 0.7;  // floor of the navigation box
  int recent_poses = 50;
  double recent_distance_m = 0.05;
  double recent_yaw_rad = 0.1;
  bool allow_unknown = false;  // positions in unknown space
  PathCheck path = PathCheck::straight;
  PathSearchConfig path_search = {};
};

enum class Rejection {
  out_of_bounds,
  not_free,
  collision,
  path_blocked,
  recently_visited,
  cluster_outside_fov,  // FVS: the centroid of the cluster is in no camera's frustum
  cluster_hidden,       // FVS: no voxel of the cluster is visible
  sees_no_surface,      // refused by the utility
  no_fly,               // in or too near to a box where nobody may fly
  beyond_gimbal         // a given view: no gimbal reaches its pitch
};
std::string_view name_of(Rejection reason);

/// The workspace, with its floor raised to z_min_m.
Box3 navigation_box_m(const ValidityConfig& config, const Box3& workspace_m);

/// Checks views from one place, one after another; those of one position share its checks.
class ViewChecker {
 public:
  /// Keeps references to all of them.
  ViewChecker(const ValidityConfig& config, const Box3& navigation_m, const NoFly& no_fly,
              const OccupancyGrid& grid, std::span<const ViewPose> recent, const ViewPose& current)
      : config_(config),
        navigation_m_(navigation_m),
        no_fly_(no_fly),
        grid_(grid),
        recent_(recent),
        current_(current) {}

  /// Fills in whether the candidate may be flown to, and the way there.
  void check(Candidate& candidate);
  /// What forbids the view whatever way leads to it.
  std::optional<Rejection> rejection_there(const ViewPose& view) const;

 private:
  struct Reachability {
    std::optional<Rejection> rejected;  // nothing: it may
    std::vector<Vec3> via_world_m;      // points between here and there; empty: straight
  };
  const Reachability& reachability(const ViewPose& view);
  std::optional<Rejection> rejection_at(const Vec3& p_world_m) const;
  Reachability check_position(const Vec3& p_world_m) const;

  const ValidityConfig& config_;
  const Box3& navigation_m_;
  const NoFly& no_fly_;
  const OccupancyGrid& grid_;
  std::span<const ViewPose> recent_;
  const ViewPose& current_;
  std::optional<Vec3> checked_m_;  // the position at hand, and what was found there
  Reachability at_position_;
  const Reachability recently_visited_ = {Rejection::recently_visited, {}};
};

}  // namespace gnbv
