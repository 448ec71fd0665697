#include <algorithm>
#include <limits>
#include <utility>
#include <variant>

#include "tools/mission/mission_state.hpp"

namespace gnbv {
namespace {

/// What the vehicle follows; before it follows a way, it is at rest where it believes to be.
Reference reference_now(const Mission& m) {
  if (m.path_at > 0) return m.path[m.path_at - 1];
  const Isometry T = m.flight->estimate().T_world_body;
  return {.p_world_m = T.translation(), .yaw_rad = yaw_of(T)};
}

/// Asked of chords of a tenth of a second, from which the way is off by a t^2 / 8, 1.3 mm at 1
/// m/s2.
bool is_way_free(const Mission& m, const Vec3& from_m, std::span<const Reference> path) {
  constexpr std::size_t kChord = 5;
  constexpr double kOvershoot_m = 0.2;  // beyond the navigation box, of a curve
  const Vec3 slack_m = Vec3::Constant(kOvershoot_m);
  const Box3 box_m(m.model.navigation_m.min() - slack_m, m.model.navigation_m.max() + slack_m);
  Vec3 at_m = from_m;
  for (std::size_t i = kChord - 1; i < path.size() + kChord - 1; i += kChord) {
    const Vec3& to_m = path[std::min(i, path.size() - 1)].p_world_m;
    if (!box_m.contains(to_m) || !is_leg_free(m, at_m, to_m)) return false;
    if (!is_clear_of_movers(m, to_m, static_cast<double>(i + 1) * kReference_s)) return false;
    at_m = to_m;
  }
  return true;
}

constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();

/// How far ahead the way is watched: a little more than it takes to brake.
constexpr double kWatched_s = 2.5;
constexpr std::int64_t kTicksPerWatch = kTicksPerSecond / 5;

enum class WayEnd { passed, blocked };

/// Flies on until so many poses are passed; what ends the mission meanwhile. `blocked`: frames on
/// the way have shown that it is not clear.
std::variant<WayEnd, Termination> fly_on(Mission& m, std::size_t poses,
                                         const std::function<void(const Flight&)>& on_tick,
                                         bool is_watched = true) {
  bool is_blocked = false;
  const auto watch = [&](const Flight& flight) {
    keep_track(m);
    const Reference& now = m.path[m.path_at - 1];
    m.out.path_error.add((m.last_p_world_m - now.p_world_m).norm());
    on_tick(flight);
    if (is_watched && flight.tick() % kTicksPerWatch == 0) {
      const auto ahead = std::span(m.path).subspan(m.path_at);
      const auto count = static_cast<std::size_t>(kWatched_s / kReference_s);
      is_blocked = !is_way_free(m, now.p_world_m, ahead.first(std::min(count, ahead.size())));
    }
    return goes_on(m) && !is_blocked;
  };
  const LegEnd end = fly_path(*m.flight, m.path, m.path_at, poses, m.scenario.vehicle, watch);
  if (end == LegEnd::stopped && is_blocked && goes_on(m)) return WayEnd::blocked;
  if (const auto over = over_after(m, end)) return *over;
  return WayEnd::passed;
}

/// The speed up to which surface crosses the image no faster than guidance.image_motion_max_rad_s
/// on the way from there, straight from pose to pose or as far from that as a way passes them:
/// that times the distance of the nearest voxel that is known to hold surface.
double sharp_speed_m_s(const Mission& m, const Vec3& from_m, std::span<const PassedPose> poses) {
  const GuidanceConfig& guidance = m.scenario.guidance;
  if (guidance.image_motion_max_rad_s <= 0.0) return guidance.path_speed_m_s;
  const GridGeometry& voxels = m.out.belief.grid.geometry();
  double nearest_m = guidance.path_speed_m_s / guidance.image_motion_max_rad_s;
  if (guidance.trajectory == Trajectory::smooth) nearest_m += guidance.pass_distance_m;
  for (const VoxelIndex voxel : m.out.belief.cloud.voxels()) {
    const Vec3 p_m = voxels.center_m(voxels.key_at(voxel));
    Vec3 at_m = from_m;
    for (const PassedPose& pose : poses) {
      nearest_m = std::min(nearest_m, distance_to_segment_m(p_m, at_m, pose.pose.p_world_m));
      at_m = pose.pose.p_world_m;
    }
  }
  if (guidance.trajectory == Trajectory::smooth) nearest_m -= guidance.pass_distance_m;
  const double least_m = m.model.validity.collision_radius_m;
  return guidance.image_motion_max_rad_s * std::max(nearest_m, least_m);
}

/// Takes up the smooth way from here past the poses, if it may be flown; `nearness`: how near to
/// them, as a share of the distance allowed.
bool take_way(Mission& m, std::span<const PassedPose> poses, double nearness, double speed_m_s) {
  const Reference from = reference_now(m);
  GuidanceConfig guidance = m.scenario.guidance;
  guidance.pass_distance_m *= nearness;
  auto path = smooth_path(from, poses, speed_m_s, guidance, m.scenario.vehicle);
  if (path.empty() || !is_way_free(m, from.p_world_m, path)) return false;
  m.path = std::move(path);
  m.path_at = 0;
  return true;
}

/// A way past the view: on to as many of the poses after it as may be, or to a stop at it; else
/// with narrower corners, and slowly at last.
bool find_way(Mission& m, const Decision& next) {
  std::vector<PassedPose> poses;
  for (const Vec3& via_m : next.via_world_m) poses.push_back({{via_m, next.view.yaw_rad}, false});
  poses.push_back({next.view});
  const std::size_t to_view = poses.size();
  for (const Onward& onward : next.then) poses.push_back({onward.pose, onward.is_view});
  const double speed_m_s = sharp_speed_m_s(m, reference_now(m).p_world_m, poses);
  for (const double nearness : {1.0, 0.4, 0.15}) {
    for (std::size_t count = poses.size(); count >= to_view; --count) {
      if (take_way(m, std::span(poses).first(count), nearness, speed_m_s)) return true;
    }
  }
  return take_way(m, std::span(poses).first(to_view), 0.15, 0.5 * speed_m_s);
}

/// Takes up the way to a stop, straight on; keeps the way at hand while that is clear and the
/// straight is not. Whether it keeps it.
bool take_stop(Mission& m, bool is_way_clear) {
  const Reference now = reference_now(m);
  const double speed_m_s = now.v_world_m_s.norm();
  const double braking_m = 0.7 * speed_m_s * speed_m_s / m.scenario.guidance.acceleration_m_s2;
  const PassedPose at = {{now.p_world_m + braking_m / speed_m_s * now.v_world_m_s, now.yaw_rad},
                         false};
  auto path = smooth_path(now, {&at, 1}, m.scenario.guidance.path_speed_m_s, m.scenario.guidance,
                          m.scenario.vehicle);
  if (is_way_clear && !is_way_free(m, now.p_world_m, path) &&
      is_way_free(m, now.p_world_m, std::span(m.path).subspan(m.path_at))) {
    return true;
  }
  m.path = std::move(path);
  m.path_at = 0;
  return false;
}

bool is_at_rest(const Mission& m) { return reference_now(m).v_world_m_s.isZero(0.0); }

/// Brakes while the mission goes on; what ends it meanwhile.
std::optional<Termination> stop(Mission& m, bool is_way_clear,
                                const std::function<void(const Flight&)>& on_tick) {
  if (is_at_rest(m)) return std::nullopt;
  const bool keeps_to_way = take_stop(m, is_way_clear);
  const auto end = fly_on(m, kAll, on_tick, keeps_to_way);
  const auto* const flown = std::get_if<WayEnd>(&end);
  if (flown != nullptr && *flown == WayEnd::blocked) return stop(m, false, on_tick);
  const auto* const over = std::get_if<Termination>(&end);
  return over != nullptr ? std::optional(*over) : std::nullopt;
}

/// Of the way to the view the exits at the ends of the leg at hand: what lies beside it may be in
/// the way to others.
void keep_exits(Mission& m, std::size_t leg) {
  if (m.corners.empty()) return;
  leg = std::min(leg, m.corners.size() - 2);
  m.exits = {m.corners[leg], m.corners[leg + 1]};
}

/// Where the vehicle believes to be, for the planner.
void set_current(Mission& m, double gimbal_pitch_rad) {
  const Isometry T = m.flight->estimate().T_world_body;
  m.current = {T.translation(), yaw_of(T), gimbal_pitch_rad};
}

}  // namespace

std::optional<Termination> fly_legs(Mission& m, const Decision& next,
                                    const std::function<void(const Flight&)>& on_tick) {
  std::vector<ViewPose> legs;
  for (const Vec3& via_m : next.via_world_m) {
    legs.push_back({via_m, next.view.yaw_rad, next.view.gimbal_pitch_rad});
  }
  legs.push_back(next.view);
  const bool was_planned_from_here = m.scenario.guidance.trajectory == Trajectory::legs;
  // since they were planned, a body may have come, or a leg before them was given up
  bool is_map_asked = std::ranges::any_of(
      m.scenario.obstacles, [](const auto& body) { return !body.motion.waypoints.empty(); });
  for (std::size_t i = 0; i < legs.size(); ++i) {
    const Vec3 here_m = m.flight->estimate().T_world_body.translation();
    const bool is_open = was_planned_from_here
                             ? !is_map_asked || leg_space(m).is_leg_clear(here_m, legs[i].p_world_m)
                             : is_leg_free(m, here_m, legs[i].p_world_m);
    if (!is_open) {
      set_current(m, m.gimbal_pitch_rad);
      ++m.out.legs_timed_out;
      return std::nullopt;
    }
    keep_exits(m, i);
    const PassedPose end = {legs[i]};
    const int given_up = m.out.legs_timed_out;
    const auto over = fly_leg(m, legs[i], sharp_speed_m_s(m, here_m, {&end, 1}), on_tick);
    if (over) return over;
    is_map_asked |= m.out.legs_timed_out != given_up;
  }
  return std::nullopt;
}

std::optional<Termination> fly_past(Mission& m, const Decision& next,
                                    const std::function<void(const Flight&)>& on_tick) {
  bool has_way = find_way(m, next);
  if (!has_way && m.path_at > 0) {
    if (const auto over = stop(m, true, on_tick)) return over;
    has_way = find_way(m, next);
  }
  if (!has_way) {
    m.path.clear();
    m.path_at = 0;
    return fly_legs(m, next, on_tick);
  }
  std::size_t corner = kAll;
  const auto end = fly_on(m, next.via_world_m.size() + 1, [&](const Flight& flight) {
    const std::size_t passed = m.path[m.path_at - 1].passed;
    if (passed != std::exchange(corner, passed)) keep_exits(m, passed);
    on_tick(flight);
  });
  if (const auto* const over = std::get_if<Termination>(&end)) return *over;
  if (std::get<WayEnd>(end) == WayEnd::blocked) {
    if (const auto over = stop(m, false, on_tick)) return over;
    ++m.out.legs_timed_out;
  }
  set_current(m, next.view.gimbal_pitch_rad);
  return std::nullopt;
}

std::optional<Termination> come_to_rest(Mission& m,
                                        const std::function<void(const Flight&)>& on_tick) {
  const bool was_at_rest = is_at_rest(m);
  if (was_at_rest) m.path.clear();
  if (!was_at_rest) take_stop(m, true);
  const LegEnd end =
      fly_path(*m.flight, m.path, m.path_at, kAll, m.scenario.vehicle, [&](const Flight& flight) {
        keep_track(m);
        on_tick(flight);
        return true;
      });
  m.path.clear();
  m.path_at = 0;
  const Vec3 here_m = m.flight->estimate().T_world_body.translation();
  if (!was_at_rest && !is_leg_free(m, here_m, m.current.p_world_m)) {
    set_current(m, m.current.gimbal_pitch_rad);
  }
  return end == LegEnd::collision ? std::optional(Termination::collision) : std::nullopt;
}

}  // namespace gnbv
