#include "planner/motion/view_checker.hpp"

#include <algorithm>
#include <cmath>

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

std::optional<Rejection> ViewChecker::rejection_there(const ViewPose& view) const {
  if (is_recent(config_, recent_, view)) return Rejection::recently_visited;
  return space_.rejection_at(view.p_world_m, current_.p_world_m);
}

FoundPath ViewChecker::path_to(const Vec3& p_world_m) const {
  const Vec3& from_m = current_.p_world_m;
  if (const auto rejected = space_.rejection_at(p_world_m, from_m)) return {rejected, {}};
  switch (config_.path) {
    case PathCheck::unchecked:
      if (space_.no_fly.allows_leg(from_m, p_world_m)) return {};
      break;
    case PathCheck::straight:
      if (space_.is_leg_clear(from_m, p_world_m)) return {};
      break;
    case PathCheck::astar:
      if (space_.is_leg_free(from_m, p_world_m)) return {};
      return find_path(config_.path_search, space_, from_m, p_world_m, heed_stop_);
  }
  return {Rejection::path_blocked, {}};
}

FoundPath ViewChecker::check(const ViewPose& view) {
  if (is_recent(config_, recent_, view)) return {Rejection::recently_visited, {}};
  if (checked_m_ != view.p_world_m) {
    checked_m_ = view.p_world_m;
    at_position_ = path_to(view.p_world_m);
  }
  return at_position_;
}

}  // namespace gnbv
