#include "planner/view_validity.hpp"

#include <algorithm>
#include <cmath>

namespace gnbv {
namespace {

bool is_recent(const ValidityConfig& config, std::span<const ViewPose> recent,
               const ViewPose& view) {
  return std::any_of(recent.begin(), recent.end(), [&](const ViewPose& pose) {
    return (pose.p_world_m - view.p_world_m).norm() < config.recent_distance_m &&
           std::fabs(wrap_angle_rad(pose.yaw_rad - view.yaw_rad)) < config.recent_yaw_rad;
  });
}

}  // namespace

std::string_view name_of(Rejection reason) {
  switch (reason) {
    case Rejection::out_of_bounds:
      return "out_of_bounds";
    case Rejection::not_free:
      return "not_free";
    case Rejection::collision:
      return "collision";
    case Rejection::path_blocked:
      return "path_blocked";
    case Rejection::recently_visited:
      return "recently_visited";
    case Rejection::cluster_outside_fov:
      return "cluster_outside_fov";
    case Rejection::cluster_hidden:
      return "cluster_hidden";
    case Rejection::sees_no_surface:
      return "sees_no_surface";
  }
  return "unknown";
}

Box3 navigation_box_m(const ValidityConfig& config, const Box3& workspace_m) {
  Box3 box = workspace_m;
  box.min().z() = std::max(box.min().z(), config.z_min_m);
  return box;
}

Reachability ViewChecker::check_position(const Vec3& p_world_m) const {
  if (grid_.state_at(grid_.geometry().nearest_inside(p_world_m)) != VoxelState::free) {
    return {Rejection::not_free, {}};
  }
  const double radius_m = config_.collision_radius_m;
  if (!is_sphere_clear(grid_, p_world_m, radius_m)) return {Rejection::collision, {}};
  if (config_.path == PathCheck::unchecked) return {};
  const Vec3& from_m = current_.p_world_m;
  if (is_path_clear(grid_, from_m, p_world_m, radius_m)) return {};
  if (config_.path == PathCheck::astar) {
    auto via_m = find_path(config_.path_search, grid_, navigation_m_, from_m, p_world_m, radius_m);
    if (via_m) return {std::nullopt, std::move(*via_m)};
  }
  return {Rejection::path_blocked, {}};
}

const Reachability& ViewChecker::check(const ViewPose& candidate) {
  // a lattice walked in steps ends on the box's faces but for rounding
  constexpr double kRounding_m = 1e-6;
  const Vec3& p = candidate.p_world_m;
  if (is_recent(config_, recent_, candidate)) return recently_visited_;
  if (checked_m_ != p) {
    checked_m_ = p;
    at_position_ = navigation_m_.squaredExteriorDistance(p) > kRounding_m * kRounding_m
                       ? Reachability{Rejection::out_of_bounds, {}}
                       : check_position(p);
  }
  return at_position_;
}

std::optional<Rejection> rejection(const ValidityConfig& config, const Box3& navigation_m,
                                   const OccupancyGrid& grid, std::span<const ViewPose> recent,
                                   const ViewPose& current, const ViewPose& candidate) {
  return ViewChecker(config, navigation_m, grid, recent, current).check(candidate).rejected;
}

}  // namespace gnbv
