#include <algorithm>
#include <limits>

#include "planner/motion/free_space.hpp"
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
  const FreeSpace space = free_space(m);
  Vec3 at_m = from_m;
  for (std::size_t i = kChord - 1; i < path.size() + kChord - 1; i += kChord) {
    const Vec3& to_m = path[std::min(i, path.size() - 1)].p_world_m;
    if (!space.is_leg_free(at_m, to_m)) return false;
    at_m = to_m;
  }
  return true;
}

constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();

LegEnd fly_on(Mission& m, std::size_t poses, const std::function<void(const Flight&)>& on_tick) {
  return fly_path(*m.flight, m.path, m.path_at, poses, m.scenario.vehicle,
                  [&](const Flight& flight) {
                    keep_track(m);
                    const Vec3& to_m = m.path[m.path_at - 1].p_world_m;
                    m.out.path_error.add((m.last_p_world_m - to_m).norm());
                    on_tick(flight);
                    return goes_on(m);
                  });
}

/// A way past the view that may be flown: on to the views after it, to a stop at it, or that
/// slowly.
bool find_way(Mission& m, const Decision& next) {
  const Reference from = reference_now(m);
  std::vector<PassedPose> poses;
  for (const Vec3& via_m : next.via_world_m) {
    poses.push_back({{via_m, next.view.yaw_rad}, false});
  }
  poses.push_back({next.view});
  const std::size_t to_view = poses.size();
  for (const ViewPose& view : next.then) poses.push_back({view});
  const double speed_m_s = m.scenario.guidance.path_speed_m_s;
  const auto try_way = [&](std::size_t count, double share) {
    auto path = smooth_path(from, std::span(poses).first(count), share * speed_m_s,
                            m.scenario.guidance, m.scenario.vehicle);
    if (path.empty() || !is_way_free(m, from.p_world_m, path)) return false;
    m.path = std::move(path);
    m.path_at = 0;
    return true;
  };
  return try_way(poses.size(), 1.0) || try_way(to_view, 1.0) || try_way(to_view, 0.5);
}

}  // namespace

std::optional<Termination> fly_past(Mission& m, const Decision& next,
                                    const std::function<void(const Flight&)>& on_tick) {
  if (!find_way(m, next)) {
    if (const auto over = over_after(m, fly_on(m, kAll, on_tick))) return over;
    m.path.clear();
    m.path_at = 0;
    std::vector<ViewPose> legs;
    for (const Vec3& via_m : next.via_world_m) legs.push_back({via_m, next.view.yaw_rad, 0.0});
    legs.push_back(next.view);
    for (const ViewPose& leg : legs) {
      if (const auto over = fly_leg(m, leg, m.scenario.guidance.path_speed_m_s, on_tick)) {
        return over;
      }
    }
    return std::nullopt;
  }
  const LegEnd end = fly_on(m, next.via_world_m.size() + 1, on_tick);
  if (const auto over = over_after(m, end)) return over;
  const Isometry T = m.flight->estimate().T_world_body;
  m.current = {T.translation(), yaw_of(T), next.view.gimbal_pitch_rad};
  return std::nullopt;
}

void come_to_rest(Mission& m) {
  fly_path(*m.flight, m.path, m.path_at, kAll, m.scenario.vehicle, [&](const Flight&) {
    keep_track(m);
    return true;
  });
  m.path.clear();
  m.path_at = 0;
}

}  // namespace gnbv
