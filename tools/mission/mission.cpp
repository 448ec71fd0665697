#include "tools/mission/mission.hpp"

#include <cmath>
#include <utility>

#include "planner/follow_route.hpp"
#include "planner/map/path_search.hpp"
#include "planner/next_view.hpp"
#include "sim/core/error.hpp"
#include "tools/mission/given_route.hpp"
#include "tools/mission/homing.hpp"
#include "tools/mission/mission_state.hpp"
#include "tools/mission/sensing.hpp"

namespace gnbv {
namespace {

/// Of a gimbal: MAVLink's gimbal protocol leaves the rate to the device; small ones do 60 to 180.
constexpr double kGimbalRate_rad_s = deg_to_rad(60.0);

/// The camera as it looks now.
CameraModel camera_now(const Mission& m, std::size_t camera) {
  return turned(m.planner.cameras[camera], m.gimbal_pitch_rad);
}

/// The camera's depth frame now, counted; nothing when it is lost.
std::optional<DepthFrame> take_frame(Mission& m, std::size_t camera) {
  if (is_dropped(m.planner.cameras[camera].config, camera, m.flight->tick(), m.scenario.seed)) {
    ++m.out.frames.dropped;
    return std::nullopt;
  }
  ++m.out.frames.taken;
  return sense_depth(m.scene, camera_now(m, camera), static_cast<int>(camera), *m.flight,
                     m.scenario.seed, m.bench.threads);
}

/// One tick of the gimbal towards the view's pitch.
void turn_gimbal(Mission& m, const ViewPose& view) {
  constexpr double kStep_rad = kGimbalRate_rad_s * kTick_s;
  const double to_go_rad = view.gimbal_pitch_rad - m.gimbal_pitch_rad;
  m.gimbal_pitch_rad = std::abs(to_go_rad) <= kStep_rad
                           ? view.gimbal_pitch_rad
                           : m.gimbal_pitch_rad + std::copysign(kStep_rad, to_go_rad);
}

/// Flies to the view, the gimbal turning from the first tick on, and waits there until it has;
/// cameras that run in flight are believed on the way. A frame is believed one tick late, so that
/// one due on arrival is left to the view itself.
std::optional<Termination> fly_to_view(Mission& m, const Decision& next) {
  const ScopeTimer timer(m.view_wall.fly_s);
  m.entropy_before_nat = m.out.belief.grid.total_entropy_nat();
  m.out.distance.straight_m +=
      path_length_m(m.current.p_world_m, next.via_world_m, next.view.p_world_m);
  std::vector<DepthFrame> pending;
  const auto look = [&](const Flight& flight) {
    integrate_view(m.planner, pending, m.bench, m.out.belief);
    pending.clear();
    turn_gimbal(m, next.view);
    for (std::size_t i = 0; i < m.planner.cameras.size(); ++i) {
      if (!is_due(m.planner.cameras[i].config.rate_hz, flight.tick())) continue;
      if (auto frame = take_frame(m, i)) pending.push_back(std::move(*frame));
    }
  };
  std::vector<ViewPose> legs;
  for (const Vec3& via_m : next.via_world_m) {
    legs.push_back({via_m, next.view.yaw_rad, next.view.gimbal_pitch_rad});
  }
  legs.push_back(next.view);
  const double speed_m_s = m.scenario.guidance.path_speed_m_s;
  std::optional<Termination> over;
  for (std::size_t i = 0; i < legs.size() && !over; ++i) {
    // no nearer to home than the ends of the leg at hand: what lies beside it may be in the way
    if (!m.corners.empty()) m.exits = {m.corners[i], m.corners[i + 1]};
    over = fly_leg(m, legs[i], speed_m_s, look);
  }
  while (!over && m.gimbal_pitch_rad != next.view.gimbal_pitch_rad) {
    over = fly_leg(m, next.view, speed_m_s, look);
  }
  m.out.distance.flown_m = m.flown_m;
  return over;
}

std::vector<DepthFrame> sense(Mission& m) {
  const ScopeTimer timer(m.view_wall.sense_s);
  std::vector<DepthFrame> frames;
  for (std::size_t i = 0; i < m.planner.cameras.size(); ++i) {
    if (auto frame = take_frame(m, i)) frames.push_back(std::move(*frame));
  }
  m.hooks.on_sensed(m.flight->estimate().T_world_body, frames);
  if (!m.hooks.on_frames) return frames;
  std::vector<ColourFrame> colours;
  for (const DepthFrame& frame : frames) {
    colours.push_back(sense_colour(m.scene, camera_now(m, static_cast<std::size_t>(frame.camera)),
                                   frame.camera, *m.flight, m.bench.threads));
  }
  m.hooks.on_frames(m.out.views.size(), time_s(*m.flight), frames, colours);
  return frames;
}

void integrate(Mission& m, std::span<const DepthFrame> frames) {
  const ScopeTimer timer(m.view_wall.map_s);
  integrate_view(m.planner, frames, m.bench, m.out.belief);
  remember_entropy(m.out.belief, m.entropy_before_nat, m.history);
}

void record(Mission& m, const Decision& decision) {
  m.history.decisions.push_back(decision);
  if (m.next_given > 0) m.out.given_views[m.next_given - 1].iteration = m.out.views.size();
  const Belief& belief = m.out.belief;
  remember_progress(belief, m.out.distance.straight_m, m.history);
  const std::size_t points = belief.cloud.points_world_m().size();
  const std::size_t occupied = belief.grid.occupied_count();
  m.out.views.push_back(
      {.iteration = static_cast<int>(m.out.views.size()),
       .decision = decision,
       .entropy_nat = belief.grid.total_entropy_nat(),
       .density_points_per_voxel =
           occupied == 0 ? 0.0 : static_cast<double>(points) / static_cast<double>(occupied),
       .cloud_points = points,
       .straight_m = m.out.distance.straight_m,
       .flown_m = m.out.distance.flown_m,
       .time_s = time_s(*m.flight),
       .wall = m.view_wall});
  m.out.wall.sense_s += m.view_wall.sense_s;
  m.out.wall.map_s += m.view_wall.map_s;
  m.out.wall.plan_s += m.view_wall.plan_s;
  m.out.wall.fly_s += m.view_wall.fly_s;
  m.view_wall = {};
  m.hooks.on_view(m.out.views.back());
  m.hooks.on_view_belief(belief);
  m.exits = exits_here(m);
  m.corners.clear();
}

std::optional<Termination> termination(const Mission& m) {
  const TerminationConfig& config = m.planner.config.termination;
  if (m.hooks.is_covered(m.out.belief)) return Termination::coverage_reached;
  if (m.out.views.size() >= static_cast<std::size_t>(config.max_iterations)) {
    return Termination::max_iterations;
  }
  if (!m.hooks.route && !flies_given(m)) {
    // a tour knows itself when the map has nothing more to tell
    const std::span<const double> entropies_nat =
        m.tour ? std::span<const double>() : std::span(m.history.entropies_nat);
    if (const auto end = believed_end(config, entropies_nat, m.history.progress)) return end;
    if (!m.tour && is_back_and_forth(positions_of(m.history), config.repeated_moves)) {
      return Termination::repeated_motion;
    }
  } else if (m.hooks.route && m.out.views.size() > m.hooks.route->size()) {
    return Termination::route_flown;
  }
  if (should_stop(m)) return Termination::interrupted;
  return std::nullopt;
}

/// Keeps the record of a decision.
std::optional<Decision> chosen_of(Mission& m, std::size_t next, Plan plan) {
  m.hooks.on_candidates(next, plan);
  if (!plan.next) {
    for (const Candidate& candidate : plan.candidates) {
      if (candidate.rejected) ++m.out.last_rejections[*candidate.rejected];
    }
  }
  return std::move(plan.next);
}

/// A tour learns from every view, so that it is asked again for the decisions of a replay.
std::optional<Decision> decide_tour(Mission& m, std::size_t next) {
  Plan plan = m.tour->next(m.out.belief, m.history, m.current, m.bench);
  for (const LookOutcome& look : m.tour->outcomes()) {
    m.out.look_outcomes.push_back({next - 1, look});
  }
  if (m.tour->plan()) m.out.tour_plans.push_back({next, *m.tour->plan()});
  if (next < m.hooks.replay.size()) {
    need_as_recorded(m, plan.next, next);
    return m.hooks.replay[next];
  }
  return chosen_of(m, next, std::move(plan));
}

std::optional<Decision> decide(Mission& m) {
  const ScopeTimer timer(m.view_wall.plan_s);
  const std::size_t next = m.history.decisions.size();
  if (flies_given(m)) return next_given_view(m);
  if (m.tour) return decide_tour(m, next);
  if (next < m.hooks.replay.size()) return m.hooks.replay[next];
  if (m.hooks.route) return m.hooks.route->at(next - 1);  // decision 0 is the start
  Plan plan = m.laid_route
                  ? follow_route(m.planner, m.out.belief, m.history, *m.laid_route, m.current)
                  : plan_next_view(m.planner, m.out.belief, m.history, m.current, m.bench);
  return chosen_of(m, next, std::move(plan));
}

/// Why there is no next view.
Termination end_without_view(const Mission& m) {
  if (flies_given(m)) return end_of_given(m);
  return m.tour && m.tour->is_complete() ? Termination::tour_complete : Termination::no_valid_view;
}

/// Whether the way to the view is longer than the mission may go on.
bool is_too_far(const Mission& m, const Decision& next) {
  return is_too_far(m.planner.config.termination, m.out.distance.straight_m,
                    path_length_m(m.current.p_world_m, next.via_world_m, next.view.p_world_m));
}

MissionResult finish(Mission& m, Termination reason) {
  m.out.termination = reason;
  if (ends_at_home(m, reason)) fly_home(m);
  m.out.flight_time_s = time_s(*m.flight);
  m.out.energy_wh = m.flight->energy_wh();
  m.out.final_state = m.flight->state();
  return std::move(m.out);
}

}  // namespace

MissionResult run_mission(const Scenario& scenario, const World& world, const RayScene& scene,
                          const MissionHooks& hooks, int threads) {
  GNBV_CHECK(hooks.route || !is_oracle(scenario.planner.utility.name), "{} without its route",
             scenario.planner.utility.name);
  Mission m(scenario, world, scene, hooks, threads);
  if (const auto over = fly_profile(m)) return finish(m, *over);
  Decision next = {.view = m.out.start};
  while (true) {
    if (const auto over = fly_to_view(m, next)) return finish(m, *over);
    integrate(m, sense(m));
    record(m, next);
    if (const auto over = termination(m)) return finish(m, *over);
    std::optional<Decision> decision;
    try {
      decision = decide(m);
    } catch (const OwnUtilityFailed& failed) {
      m.out.failure = failed.what();
      return finish(m, Termination::utility_failed);
    }
    if (!decision) return finish(m, end_without_view(m));
    if (is_too_far(m, *decision)) return finish(m, Termination::max_distance);
    if (!can_afford(m, *decision)) return finish(m, Termination::battery);
    next = *decision;
  }
}

}  // namespace gnbv
