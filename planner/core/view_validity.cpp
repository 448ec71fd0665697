#include "planner/core/view_validity.hpp"

#include <algorithm>
#include <cmath>

#include "planner/core/plan.hpp"
#include "planner/map/clearance.hpp"
#include "planner/map/no_fly.hpp"
#include "planner/map/path_search.hpp"

namespace gnbv {
namespace {

bool is_recent(const ValidityConfig& config, std::span<const ViewPose> recent,
               const ViewPose& view) {
  return std::any_of(recent.begin(), recent.end(), [&](const ViewPose& pose) {
    return (pose.p_world_m - view.p_world_m).norm() < config.recent_distance_m &&
           std::fabs(wrap_angle_rad(pose.yaw_rad - view.yaw_rad)) < config.recent_yaw_rad &&
           std::fabs(pose.gimbal_pitch_rad - view.gimbal_pitch_rad) < config.recent_yaw_rad;
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
    case Rejection::no_fly:
      return "no_fly";
    case Rejection::beyond_gimbal:
      return "beyond_gimbal";
  }
  return "unknown";
}

Box3 navigation_box_m(const ValidityConfig& config, const Box3& workspace_m) {
  Box3 box = workspace_m;
  box.min().z() = std::max(box.min().z(), config.z_min_m);
  return box;
}

std::optional<Rejection> ViewChecker::rejection_at(const Vec3& p_world_m) const {
  // a lattice walked in steps ends on the box's faces but for rounding
  constexpr double kRounding_m = 1e-6;
  if (navigation_m_.squaredExteriorDistance(p_world_m) > kRounding_m * kRounding_m) {
    return Rejection::out_of_bounds;
  }
  if (!no_fly_.allows(p_world_m)) return Rejection::no_fly;
  const VoxelState state = grid_.state_at(grid_.geometry().nearest_inside(p_world_m));
  if (state == VoxelState::occupied || (state == VoxelState::unknown && !config_.allow_unknown)) {
    return Rejection::not_free;
  }
  if (!is_sphere_clear(grid_, p_world_m, config_.collision_radius_m)) return Rejection::collision;
  return std::nullopt;
}

std::optional<Rejection> ViewChecker::rejection_there(const ViewPose& view) const {
  if (is_recent(config_, recent_, view)) return Rejection::recently_visited;
  return rejection_at(view.p_world_m);
}

ViewChecker::Reachability ViewChecker::check_position(const Vec3& p_world_m) const {
  if (const auto rejected = rejection_at(p_world_m)) return {rejected, {}};
  const double radius_m = config_.collision_radius_m;
  const Vec3& from_m = current_.p_world_m;
  const bool is_allowed = no_fly_.allows_leg(from_m, p_world_m);
  if (is_allowed && config_.path == PathCheck::unchecked) return {};
  const bool is_known = config_.path != PathCheck::astar || config_.allow_unknown ||
                        is_line_free(grid_, from_m, p_world_m);
  if (is_allowed && is_known && is_path_clear(grid_, from_m, p_world_m, radius_m)) return {};
  if (config_.path == PathCheck::astar) {
    auto via_m = find_path(config_.path_search, grid_, navigation_m_, from_m, p_world_m, radius_m,
                           no_fly_, config_.allow_unknown);
    if (via_m) return {std::nullopt, std::move(*via_m)};
  }
  return {Rejection::path_blocked, {}};
}

const ViewChecker::Reachability& ViewChecker::reachability(const ViewPose& view) {
  if (is_recent(config_, recent_, view)) return recently_visited_;
  if (checked_m_ != view.p_world_m) {
    checked_m_ = view.p_world_m;
    at_position_ = check_position(view.p_world_m);
  }
  return at_position_;
}

void ViewChecker::check(Candidate& candidate) {
  const Reachability& found = reachability(candidate.view);
  candidate.rejected = found.rejected;
  candidate.via_world_m = found.via_world_m;
  candidate.path_m =
      path_length_m(current_.p_world_m, candidate.via_world_m, candidate.view.p_world_m);
}

}  // namespace gnbv
