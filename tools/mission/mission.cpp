#include "tools/mission/mission.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "planner/tour/gains.hpp"
#include "tools/mission/mission_state.hpp"
#include "tools/mission/sensing.hpp"

namespace gnbv {
namespace {

/// Of a gimbal: MAVLink's gimbal protocol leaves the rate to the device; small ones do 60 to 180.
constexpr double kGimbalRate_rad_s = deg_to_rad(60.0);

/// The camera as it looks now.
CameraModel camera_now(const Mission& m, std::size_t camera) {
  return turned(m.model.cameras[camera], m.gimbal_pitch_rad);
}

/// The camera's depth frame now, counted; nothing when it is lost.
std::optional<DepthFrame> take_frame(Mission& m, std::size_t camera) {
  if (is_dropped(m.model.cameras[camera].config, camera, m.flight->tick(), m.scenario.seed)) {
    ++m.out.frames.dropped;
    return std::nullopt;
  }
  ++m.out.frames.taken;
  return sense_depth(m.scene, camera_now(m, camera), static_cast<int>(camera), *m.flight,
                     m.scenario.seed, m.scratch.threads);
}

/// One tick of the gimbal towards the view's pitch.
void turn_gimbal(Mission& m, const ViewPose& view) {
  constexpr double kStep_rad = kGimbalRate_rad_s * kTick_s;
  const double to_go_rad = view.gimbal_pitch_rad - m.gimbal_pitch_rad;
  m.gimbal_pitch_rad = std::abs(to_go_rad) <= kStep_rad
                           ? view.gimbal_pitch_rad
                           : m.gimbal_pitch_rad + std::copysign(kStep_rad, to_go_rad);
}

/// After each tick on the way to a view: the gimbal turns, and what runs in flight is believed. A
/// frame is believed one tick late, so that one due on arrival is left to the view itself.
std::function<void(const Flight&)> looks_on_the_way(Mission& m, const ViewPose& view) {
  return [&m, &view, pending = std::vector<DepthFrame>()](const Flight& flight) mutable {
    m.scanner.tick(flight, true);
    for (const LidarScan& scan : m.scanner.take_scans()) {
      const bool is_view =
          m.model.lidars[static_cast<std::size_t>(scan.lidar)].config.looks == LidarLooks::flight;
      (is_view ? integrate_looks : integrate_sweeps)(m.model, std::span(&scan, 1), m.scratch,
                                                     m.out.belief);
    }
    integrate_view(m.model, pending, m.scratch, m.out.belief);
    pending.clear();
    turn_gimbal(m, view);
    for (std::size_t i = 0; i < m.model.cameras.size(); ++i) {
      if (!is_due(m.model.cameras[i].config.rate_hz, flight.tick())) continue;
      if (auto frame = take_frame(m, i)) pending.push_back(std::move(*frame));
    }
  };
}

/// From the ground to where the mission begins, straight up.
std::optional<Termination> take_off(Mission& m) {
  if (!m.scenario.start.on_ground) return std::nullopt;
  const ScopeTimer timer(m.out.wall.fly_s);
  m.out.distance.transfer_m += (m.out.start.p_world_m - m.last_p_world_m).norm();
  const auto over =
      fly_leg(m, m.out.start, m.scenario.guidance.path_speed_m_s, looks_on_the_way(m, m.out.start));
  m.flight->leave_ground();
  return over;
}

/// Flies to the view, the gimbal turning from the first tick on, and waits there until it has.
std::optional<Termination> fly_to_view(Mission& m, const Decision& next) {
  const ScopeTimer timer(m.view_wall.fly_s);
  const Vec3 from_m = m.current.p_world_m;
  const double planned_there_m = planned_m(m.history, from_m, next);
  const int given_up = m.out.legs_timed_out;
  const auto look = looks_on_the_way(m, next.view);
  const bool is_smooth = m.scenario.guidance.trajectory == Trajectory::smooth;
  std::optional<Termination> over = is_smooth ? fly_past(m, next, look) : fly_legs(m, next, look);
  const auto is_gimbal_late = [&] { return m.gimbal_pitch_rad != next.view.gimbal_pitch_rad; };
  if (!over && is_smooth && is_gimbal_late()) over = come_to_rest(m, look);
  while (!over && is_gimbal_late()) {
    over = fly_leg(m, m.current, m.scenario.guidance.path_speed_m_s, look);
  }
  m.out.distance.flown_m = m.flown_m;
  if (over) return over;
  if (m.out.legs_timed_out == given_up) {
    m.out.distance.straight_m = planned_there_m;
  } else {
    m.out.distance.straight_m += (m.current.p_world_m - from_m).norm();
  }
  return over;
}

struct Sensed {
  std::vector<DepthFrame> frames;
  std::vector<LidarScan> sweeps;
};

Sensed sense(Mission& m) {
  const ScopeTimer timer(m.view_wall.sense_s);
  Sensed sensed;
  std::vector<DepthFrame>& frames = sensed.frames;
  for (std::size_t i = 0; i < m.model.lidars.size(); ++i) {
    if (!m.model.looks(i)) continue;
    sensed.sweeps.push_back(
        sense_sweep(m.scene, m.model.lidars[i], static_cast<int>(i), *m.flight, m.scenario.seed));
  }
  for (std::size_t i = 0; i < m.model.cameras.size(); ++i) {
    if (auto frame = take_frame(m, i)) frames.push_back(std::move(*frame));
  }
  std::vector<ColourFrame> colours;
  const auto& observers = m.inputs.observers;
  if (std::any_of(observers.begin(), observers.end(), [](auto* o) { return o->wants_colour(); })) {
    for (const DepthFrame& frame : frames) {
      colours.push_back(sense_colour(m.scene, camera_now(m, static_cast<std::size_t>(frame.camera)),
                                     frame.camera, *m.flight, m.scratch.threads));
    }
  }
  tell(m, &MissionObserver::on_sensed,
       SensedView{.iteration = m.out.views.size(),
                  .time_s = time_s(*m.flight),
                  .T_world_body = m.flight->estimate().T_world_body,
                  .depth = frames,
                  .colour = colours,
                  .sweeps = sensed.sweeps});
  return sensed;
}

void integrate(Mission& m, const Sensed& sensed) {
  const ScopeTimer timer(m.view_wall.map_s);
  integrate_view(m.model, sensed.frames, m.scratch, m.out.belief);
  integrate_looks(m.model, sensed.sweeps, m.scratch, m.out.belief);
}

void record(Mission& m, const Decision& decision) {
  if (!m.out.user_views.empty()) m.out.user_views.back().iteration = m.out.views.size();
  const Belief& belief = m.out.belief;
  remember(decision, belief, m.out.distance.straight_m, m.history);
  m.taken_at_m.push_back(m.current.p_world_m);
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
       .energy_wh = m.flight->energy_wh(),
       .wall = m.view_wall});
  m.out.wall.sense_s += m.view_wall.sense_s;
  m.out.wall.map_s += m.view_wall.map_s;
  m.out.wall.plan_s += m.view_wall.plan_s;
  m.out.wall.fly_s += m.view_wall.fly_s;
  m.view_wall = {};
  tell(m, &MissionObserver::on_view, m.out.views.back(), belief);
  m.exits = exits_here(m);
  m.corners.clear();
}

void pause(const Mission& m) {
  if (!m.inputs.on_pause) return;
  m.inputs.on_pause({.views = m.out.views.size(), .keep = [&m] {
                       return std::make_shared<const MissionMoment>(m, m.scenario.seed);
                     }});
}

std::optional<Termination> termination(const Mission& m) {
  if (m.inputs.is_covered(m.out.belief)) return Termination::coverage_reached;
  if (const auto end =
          end_after_view(m.scenario.planner.termination, m.planner->end_rules(), m.history)) {
    return end;
  }
  if (should_stop(m)) return Termination::interrupted;
  return std::nullopt;
}

/// Flies there, looks, and believes what was seen.
std::optional<Termination> take_view(Mission& m, const Decision& view) {
  if (const auto over = fly_to_view(m, view)) return over;
  integrate(m, sense(m));
  record(m, view);
  return termination(m);
}

/// Keeps what the files tell of a plan, but its views, which are told when they are flown.
void keep_record(Mission& m, std::size_t iteration, const Plan& plan) {
  if (plan.tour) {
    for (const GainOutcome& gain : plan.tour->outcomes) {
      m.out.gain_outcomes.push_back({iteration - 1, gain});
    }
    if (plan.tour->plan) m.out.tour_plans.push_back({iteration, *plan.tour->plan});
  }
  if (traits_of(m.scenario.planner).takes_views) {
    for (const Candidate& c : plan.candidates) m.out.user_views.push_back({c.view, c.rejected});
  }
  if (!plan.has_view()) m.out.last_rejections = rejections_of(plan);
}

/// A plan from where the last view was taken; a mission that is flown again replays it.
Plan make_plan(Mission& m) {
  const ScopeTimer timer(m.view_wall.plan_s);
  const std::size_t iteration = m.history.decisions.size();
  const std::span<const Decision> replay = m.inputs.replay;
  const bool is_replayed = iteration < replay.size();
  Plan plan = is_replayed ? m.planner->replay(replay.subspan(iteration), m.out.belief, m.history,
                                              m.current, m.scratch)
                          : m.planner->next(m.out.belief, m.history, m.current, m.scratch);
  tell(m, is_replayed ? &MissionObserver::on_replayed : &MissionObserver::on_plan, iteration, plan);
  keep_record(m, iteration, plan);
  return plan;
}

/// Of a user's views those that the mission did not come to.
void keep_views_not_tried(Mission& m) {
  if (!traits_of(m.scenario.planner).takes_views) return;
  const std::vector<ViewPose>& views = m.scenario.planner.routes.views;
  for (std::size_t i = m.out.user_views.size(); i < views.size(); ++i) {
    m.out.user_views.push_back({views[i]});
  }
}

MissionResult finish(Mission& m, Termination reason) {
  keep_views_not_tried(m);
  if (reason != Termination::collision) {
    reason = come_to_rest(m, [](const Flight&) {}).value_or(reason);
  }
  m.out.termination = reason;
  if (ends_at_home(m, reason)) fly_home(m);
  m.out.flight_time_s = time_s(*m.flight);
  m.out.energy_wh = m.flight->energy_wh();
  m.out.final_state = m.flight->state();
  return std::move(m.out);
}

}  // namespace

MissionResult run_mission(const Scenario& scenario, const World& world, const RayScene& scene,
                          const MissionInputs& inputs, int threads) {
  const auto made = inputs.from
                        ? std::make_unique<Mission>(*inputs.from, scenario, scene, inputs, threads)
                        : std::make_unique<Mission>(scenario, world, scene, inputs, threads);
  Mission& m = *made;
  if (!inputs.from) {
    if (const auto over = take_off(m)) return finish(m, *over);
    if (const auto over = fly_profile(m)) return finish(m, *over);
    pause(m);
  }
  std::optional<Decision> view;
  if (m.out.views.empty()) {
    m.planner->begin(m.out.belief, m.out.start);
    view = Decision{.view = m.out.start};
  }
  while (true) {
    if (view) {
      if (const auto over = take_view(m, *view)) return finish(m, *over);
    }
    pause(m);
    try {
      auto next = next_decision(scenario.planner.termination, m.current, m.history,
                                [&] { return make_plan(m); });
      if (const auto* const end = std::get_if<Termination>(&next)) return finish(m, *end);
      view = std::move(std::get<Decision>(next));
    } catch (const StopRequested&) {
      return finish(m, Termination::interrupted);
    } catch (const UserUtilityFailed& failed) {
      m.out.failure = failed.what();
      return finish(m, Termination::utility_failed);
    }
    if (!can_afford(m, *view)) return finish(m, Termination::battery);
  }
}

}  // namespace gnbv
