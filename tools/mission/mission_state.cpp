#include "tools/mission/mission_state.hpp"

#include <algorithm>
#include <cmath>

#include "bench/limits/legal_viewpoints.hpp"
#include "planner/motion/paths.hpp"
#include "planner/planners.hpp"
#include "tools/mission/start_pose.hpp"
#include "tools/mission/user_planner.hpp"

namespace gnbv {
namespace {

/// Believed to be where no leg leads, and no vehicle that is in command of itself comes to.
bool is_off_course(const Mission& m) {
  constexpr double kFence_m = 3.0;  // own choice: an overshoot stays within decimetres
  const Vec3 p_m = m.flight->estimate().T_world_body.translation();
  return m.scenario.workspace_m.squaredExteriorDistance(p_m) > kFence_m * kFence_m;
}

/// Whether the mission may take longer; the way home is no part of it.
bool has_time_to_go_on(const Mission& m) {
  const double max_s = m.scenario.planner.termination.max_flight_time_s;
  return m.is_homing || max_s <= 0.0 || time_s(*m.flight) < max_s;
}

/// A leg can take minutes. The way home is flown to its end.
bool stops_on_the_way(const Mission& m) { return !m.is_homing && should_stop(m); }

PlannerModel of_seed(PlannerModel model, std::uint64_t seed) {
  model.seed = seed;
  return model;
}

}  // namespace

std::vector<CameraModel> camera_models(const Scenario& scenario) {
  std::vector<CameraModel> models;
  for (const CameraConfig& camera : scenario.cameras) models.push_back(make_camera_model(camera));
  return models;
}

PlannerModel planner_model(const Scenario& scenario) {
  PlannerModel model = make_model(scenario.planner, scenario.workspace_m, scenario.cameras,
                                  scenario.lidars, scenario.seed, no_fly_of(scenario));
  const RestToRest::Limits turn = turn_limits(scenario.guidance, scenario.vehicle);
  model.travel = {.speed_m_s = scenario.guidance.path_speed_m_s,
                  .yaw_rate_rad_s = turn.speed,
                  .yaw_acceleration_rad_s2 = turn.acceleration};
  return model;
}

MissionMoment::MissionMoment(const Scenario& scenario, const World& world, const RayScene& scene)
    : model(planner_model(scenario)),
      out(start_pose(scenario, scene), model),
      flight(make_flight(scenario.vehicle, world, out.start, scenario.seed, scenario.wind,
                         scenario.start.on_ground ? FlightStart::ground : FlightStart::air)),
      scanner(scene, model.lidars, scenario.seed, scenario.planner.profiling.flight_rate_hz),
      current(out.start),
      last_p_world_m(flight->state().T_world_body.translation()),
      gimbal_pitch_rad(out.start.gimbal_pitch_rad) {}

MissionMoment::MissionMoment(const MissionMoment& other, std::uint64_t seed)
    : model(of_seed(other.model, seed)),
      out(other.out),
      flight(other.flight->clone()),
      scanner(other.scanner, model.lidars, seed),
      history(other.history),
      current(other.current),
      taken_at_m(other.taken_at_m),
      last_p_world_m(other.last_p_world_m),
      gimbal_pitch_rad(other.gimbal_pitch_rad),
      flown_m(other.flown_m),
      path(other.path),
      path_at(other.path_at),
      exits(other.exits),
      corners(other.corners),
      is_homing(other.is_homing) {}

const Belief& belief_of(const MissionMoment& moment) { return moment.out.belief; }

bool profile_reads_seed(const Scenario& scenario) {
  const bool is_quadrotor = scenario.vehicle.kind == VehicleKind::quadrotor;
  return scenario.start.on_ground || !scenario.start.jitter_m.isZero(0.0) ||
         scenario.start.jitter_yaw_rad != 0.0 ||
         std::ranges::any_of(scenario.lidars,
                             [](const LidarConfig& lidar) { return lidar.range_sigma_m != 0.0; }) ||
         (is_quadrotor && (scenario.wind.gust_w20_m_s != 0.0 ||
                           scenario.vehicle.estimate.model != EstimateModel::none));
}

Mission::Mission(const Scenario& mission_scenario, const World& world, const RayScene& ray_scene,
                 const MissionInputs& mission_inputs, int threads)
    : MissionMoment(mission_scenario, world, ray_scene),
      scenario(mission_scenario),
      scene(ray_scene),
      inputs(mission_inputs),
      scratch(model, threads) {
  ready_planner();
}

Mission::Mission(const MissionMoment& from, const Scenario& mission_scenario,
                 const RayScene& ray_scene, const MissionInputs& mission_inputs, int threads)
    : MissionMoment(from, mission_scenario.seed),
      scenario(mission_scenario),
      scene(ray_scene),
      inputs(mission_inputs),
      scratch(model, threads) {
  ready_planner();
}

void Mission::ready_planner() {
  PlannerSources sources = inputs.sources;
  if (!sources.user_scores) sources.user_scores = lazy_user_utility(scenario.planner.utility);
  planner = make_planner(scenario.planner, model, std::move(sources));
  scratch.should_stop = [this] { return gnbv::should_stop(*this); };
}

bool should_stop(const Mission& m) {
  return m.out.views.size() >= m.inputs.replay.size() && m.inputs.should_stop();
}

double time_s(const Flight& flight) { return static_cast<double>(flight.tick()) * kTick_s; }

void keep_track(Mission& m) {
  constexpr std::int64_t kTicksPerSample = kTicksPerSecond / 10;
  const Isometry T = m.flight->state().T_world_body;
  m.flown_m += (T.translation() - m.last_p_world_m).norm();
  m.last_p_world_m = T.translation();
  if (m.flight->tick() % kTicksPerSample == 0) m.out.trajectory.push_back({time_s(*m.flight), T});
}

FreeSpace free_space(const Mission& m) {
  return {.grid = m.out.belief.grid,
          .navigation_m = m.model.navigation_m,
          .no_fly = m.model.no_fly,
          .radius_m = m.model.validity.collision_radius_m,
          .leg_keeps_start_room = true};
}

FreeSpace leg_space(const Mission& m) {
  FreeSpace space = free_space(m);
  space.allow_unknown = m.model.validity.allow_unknown;
  space.leg_radius_m = leg_radius_m(m.model.validity);
  return space;
}

bool is_leg_free(const Mission& m, const Vec3& from_world_m, const Vec3& to_world_m) {
  if (!traits_of(m.scenario.planner).knows_structure) {
    return leg_space(m).is_leg_free(from_world_m, to_world_m);
  }
  constexpr double kBeside_m = 0.05;  // that it flies beside the places planned
  return m.model.no_fly.allows_leg(from_world_m, to_world_m) &&
         is_leg_clear(m.scene, from_world_m, to_world_m,
                      m.model.validity.collision_radius_m - kBeside_m);
}

bool is_clear_of_movers(const Mission& m, const Vec3& p_world_m, double in_s) {
  const double radius_m = m.model.validity.collision_radius_m;
  return std::isinf(
      m.scene.distance_to_known_movers_m(p_world_m, time_s(*m.flight) + in_s, radius_m));
}

std::optional<std::vector<Vec3>> way_over_the_top(const Mission& m, const Vec3& from_m,
                                                  const Vec3& goal_m, bool reads_map) {
  constexpr PathSearchConfig kSearch = {.max_expansions = 20000};
  const FreeSpace space = free_space(m);
  const Box3& box_m = space.navigation_m;
  const auto is_flyable = [&](const Vec3& a_m, const Vec3& b_m) {
    return reads_map ? space.is_leg_clear(a_m, b_m) : space.no_fly.allows_leg(a_m, b_m);
  };
  const Vec3 up_m(from_m.x(), from_m.y(), box_m.max().z());
  const Vec3 across_m(goal_m.x(), goal_m.y(), box_m.max().z());
  if (is_flyable(from_m, up_m) && is_flyable(up_m, across_m) && is_flyable(across_m, goal_m)) {
    return {{up_m, across_m, goal_m}};
  }
  auto way_m = way_around(space.no_fly, box_m, from_m, goal_m, is_flyable);
  if (!way_m && reads_map) {
    FoundPath found = find_path(kSearch, space, from_m, goal_m);
    if (!found.rejected) way_m = std::move(found.via_world_m);
  }
  if (way_m) way_m->push_back(goal_m);
  return way_m;
}

bool goes_on(const Mission& m) {
  return !is_off_course(m) && has_energy_to_go_on(m) && has_time_to_go_on(m) &&
         !stops_on_the_way(m);
}

std::optional<Termination> over_after(const Mission& m, LegEnd end) {
  if (end == LegEnd::collision) return Termination::collision;
  if (end != LegEnd::stopped) return std::nullopt;
  if (is_off_course(m)) return Termination::off_course;
  if (stops_on_the_way(m)) return Termination::interrupted;
  return has_energy_to_go_on(m) ? Termination::max_flight_time : Termination::battery;
}

namespace {

/// How often along a leg it is asked where bodies will be.
constexpr double kStep_s = 0.2;

/// Whether the leg, begun after a wait, and a rest at its end keep clear of bodies whose motion is
/// known.
bool is_leg_clear_of_movers(const Mission& m, const ViewPose& from, const ViewPose& goal,
                            double speed_m_s, double wait_s, double rest_s) {
  const GuidanceConfig& guidance = m.scenario.guidance;
  const double leg_s =
      std::min(leg_duration_s(from, goal, speed_m_s, guidance, m.scenario.vehicle), kLongestLeg_s);
  for (double at_s = 0.0; at_s <= leg_s + rest_s; at_s += kStep_s) {
    const Vec3 p_m = place_on_leg_m(from, goal, at_s, speed_m_s, guidance, m.scenario.vehicle);
    if (!is_clear_of_movers(m, p_m, wait_s + at_s)) return false;
  }
  return true;
}

/// The shortest wait after which the leg is clear, as is the wait itself.
std::optional<double> wait_for_movers_s(const Mission& m, const ViewPose& from,
                                        const ViewPose& goal, double speed_m_s) {
  constexpr double kLongest_s = 60.0;
  for (double wait_s = 0.0; wait_s <= kLongest_s; wait_s += kStep_s) {
    if (is_leg_clear_of_movers(m, from, goal, speed_m_s, wait_s, kArrival_s)) return wait_s;
    if (!is_clear_of_movers(m, from.p_world_m, wait_s)) return std::nullopt;
  }
  return std::nullopt;
}

/// Out of the way of a body that comes to where the vehicle is: one of the nearest places about it
/// that may be flown to, through unseen space where there is no other. Nothing where no body
/// comes or no place will do.
std::optional<ViewPose> place_beside(const Mission& m, const ViewPose& here, double speed_m_s) {
  constexpr double kRest_s = 5.0;
  if (is_leg_clear_of_movers(m, here, here, speed_m_s, 0.0, kRest_s)) return std::nullopt;
  FreeSpace space = free_space(m);
  for (const bool allow_unknown : {false, true}) {
    space.allow_unknown = allow_unknown;
    for (const double radii : {0.5, 1.0, 2.0, 4.0}) {
      std::optional<ViewPose> found;
      for_each_key(keys_about({0, 0, 0}), [&](const Key& way) {
        ViewPose beside = here;
        beside.p_world_m +=
            radii * space.radius_m * Vec3(way[0], way[1], way[2]).stableNormalized();
        if (!found && space.contains(beside.p_world_m) &&
            space.is_leg_free(here.p_world_m, beside.p_world_m) &&
            is_leg_clear_of_movers(m, here, beside, speed_m_s, 0.0, kRest_s)) {
          found = beside;
        }
      });
      if (found) return found;
    }
  }
  return std::nullopt;
}

std::optional<Termination> stay(Mission& m, const ViewPose& here, double duration_s,
                                const std::function<void(const Flight&)>& on_tick) {
  const std::vector<Reference> still(
      static_cast<std::size_t>(std::lround(duration_s / kReference_s)),
      {.p_world_m = here.p_world_m, .yaw_rad = here.yaw_rad});
  std::size_t at = 0;
  return over_after(
      m, fly_path(*m.flight, still, at, 1, m.scenario.vehicle, [&](const Flight& flight) {
        keep_track(m);
        on_tick(flight);
        return goes_on(m);
      }));
}

std::optional<Termination> fly_straight(Mission& m, const ViewPose& from, const ViewPose& goal,
                                        double speed_m_s,
                                        const std::function<void(const Flight&)>& on_tick) {
  const LegEnd end = fly_leg(*m.flight, goal, speed_m_s, m.scenario.guidance, m.scenario.vehicle,
                             [&](const Flight& flight) {
                               keep_track(m);
                               m.out.path_error.add(distance_to_segment_m(
                                   m.last_p_world_m, from.p_world_m, goal.p_world_m));
                               on_tick(flight);
                               return goes_on(m);
                             });
  if (const auto over = over_after(m, end)) return over;
  m.current = goal;
  if (end == LegEnd::timeout) {
    ++m.out.legs_timed_out;
    const Isometry T = m.flight->estimate().T_world_body;
    m.current = {T.translation(), yaw_of(T), goal.gimbal_pitch_rad};
  }
  return std::nullopt;
}

}  // namespace

std::optional<Termination> fly_leg(Mission& m, const ViewPose& goal, double speed_m_s,
                                   const std::function<void(const Flight&)>& on_tick) {
  const Isometry T_here = m.flight->estimate().T_world_body;
  const ViewPose here = {T_here.translation(), yaw_of(T_here), goal.gimbal_pitch_rad};
  const auto wait_s = wait_for_movers_s(m, here, goal, speed_m_s);
  if (wait_s) {
    if (*wait_s > 0.0) {
      if (const auto over = stay(m, here, *wait_s, on_tick)) return over;
    }
    return fly_straight(m, here, goal, speed_m_s, on_tick);
  }
  ++m.out.legs_timed_out;
  m.current = here;
  constexpr double kStay_s = 1.0;  // before it asks again
  const auto beside = place_beside(m, here, speed_m_s);
  return beside ? fly_straight(m, here, *beside, speed_m_s, on_tick)
                : stay(m, here, kStay_s, on_tick);
}

std::optional<Termination> fly_leg(Mission& m, const ViewPose& goal) {
  return fly_leg(m, goal, m.scenario.guidance.path_speed_m_s, [](const Flight&) {});
}

}  // namespace gnbv
