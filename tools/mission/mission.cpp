#include "tools/mission/mission.hpp"

#include <chrono>
#include <memory>
#include <utility>

#include "planner/belief_file.hpp"
#include "planner/next_view.hpp"
#include "sim/flight.hpp"
#include "sim/guidance.hpp"
#include "sim/rotors.hpp"
#include "tools/mission/sensing.hpp"
#include "tools/mission/start_pose.hpp"

namespace gnbv {
namespace {

/// Adds the wall time of its scope to a counter.
class Stopwatch {
 public:
  explicit Stopwatch(double& total_s) : total_s_(total_s), begin_(Clock::now()) {}
  ~Stopwatch() { total_s_ += std::chrono::duration<double>(Clock::now() - begin_).count(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  double& total_s_;
  Clock::time_point begin_;
};

std::vector<LidarModel> lidar_models(const Scenario& scenario) {
  std::vector<LidarModel> models;
  for (const LidarConfig& lidar : scenario.lidars) models.push_back(make_lidar_model(lidar));
  return models;
}

/// All that changes while the mission runs, beside what never does.
struct Mission {
  Mission(const Scenario& mission_scenario, const World& world, const RayScene& ray_scene,
          const MissionHooks& mission_hooks, int threads)
      : scenario(mission_scenario),
        scene(ray_scene),
        hooks(mission_hooks),
        planner(scenario.planner, scenario.workspace_m, camera_models(scenario),
                lidar_models(scenario), scenario.seed),
        bench(planner, threads),
        out(start_pose(scenario, scene), planner),
        flight(make_flight(scenario.vehicle, world, out.start, scenario.seed)),
        current(out.start),
        last_p_world_m(out.start.p_world_m) {}

  const Scenario& scenario;
  const RayScene& scene;
  const MissionHooks& hooks;
  const PlannerModel planner;

  Workbench bench;

  MissionResult out;
  std::unique_ptr<Flight> flight;
  History history;
  ViewPose current;                 // where the planner believes to be
  Vec3 last_p_world_m;              // truth, one tick ago
  double flown_m = 0.0;             // truth, since the start
  double entropy_before_nat = 0.0;  // of the view at hand
  WallTimes view_wall;              // of the view at hand
};

/// A resumed run goes on until it has caught up: stopping earlier would lose recorded views.
bool should_stop(const Mission& m) {
  return m.out.views.size() >= m.hooks.replay.size() && m.hooks.should_stop();
}

double time_s(const Flight& flight) { return static_cast<double>(flight.tick()) * kTick_s; }

/// Whether what is left in the battery is more than a straight descent to the ground takes.
bool has_energy_to_go_on(const Mission& m) {
  const VehicleConfig& vehicle = m.scenario.vehicle;
  if (vehicle.power.battery_wh <= 0.0) return true;
  const double z_m = m.flight->estimate().T_world_body.translation().z();
  return m.flight->energy_wh() + landing_energy_wh(vehicle, z_m) < vehicle.power.battery_wh;
}

/// Flies one leg and keeps its track; `on_tick` runs after each tick.
std::optional<Termination> fly_leg(Mission& m, const ViewPose& goal, double speed_m_s,
                                   const std::function<void(const Flight&)>& on_tick) {
  constexpr std::int64_t kTicksPerSample = kTicksPerSecond / 10;
  const LegEnd end = fly_leg(*m.flight, goal, speed_m_s, m.scenario.guidance, m.scenario.vehicle,
                             [&](const Flight& flight) {
                               const Isometry T = flight.state().T_world_body;
                               m.flown_m += (T.translation() - m.last_p_world_m).norm();
                               m.last_p_world_m = T.translation();
                               if (flight.tick() % kTicksPerSample == 0)
                                 m.out.trajectory.push_back({time_s(flight), T});
                               on_tick(flight);
                               return has_energy_to_go_on(m);
                             });
  if (end == LegEnd::collision) return Termination::collision;
  if (end == LegEnd::stopped) return Termination::battery;
  m.current = goal;
  if (end == LegEnd::timeout) {
    ++m.out.legs_timed_out;
    const Isometry T = m.flight->estimate().T_world_body;
    m.current = {T.translation(), yaw_of(T)};
  }
  return std::nullopt;
}

std::optional<Termination> fly_leg(Mission& m, const ViewPose& goal) {
  return fly_leg(m, goal, m.scenario.guidance.path_speed_m_s, [](const Flight&) {});
}

/// Flies the legs of the profile while the LIDARs scan.
std::optional<Termination> scan_profile(Mission& m, ProfileScanner& scanner) {
  const ProfilingConfig& profiling = m.planner.config.profiling;
  const GuidanceConfig& guidance = m.scenario.guidance;
  ProfileRoute route(profiling, m.planner.navigation_m, m.current);
  std::size_t looked_at = 0;  // of the sweeps
  for (bool is_first = true;; is_first = false) {
    const auto fresh = std::span(scanner.scans()).subspan(looked_at);
    looked_at = scanner.scans().size();
    const auto leg = route.next(sees_surface(fresh, m.planner.lidars, m.planner.config.floor_z_m));
    if (!leg) return std::nullopt;
    const bool scanning = leg->is_scan || (profiling.scan_in_transit && !is_first);
    const double speed_m_s = leg->is_scan ? guidance.profile_speed_m_s : guidance.path_speed_m_s;
    m.out.distance.profile_m += (leg->goal.p_world_m - m.current.p_world_m).norm();
    const auto over = fly_leg(m, leg->goal, speed_m_s,
                              [&](const Flight& flight) { scanner.tick(flight, scanning); });
    if (over) return over;
    m.hooks.on_profile(route.share_done());
    if (should_stop(m)) return Termination::interrupted;
  }
}

/// Profiles the structure with the LIDARs and believes the scans in one batch (section 2.2), or
/// takes up the belief that an earlier profile left.
std::optional<Termination> fly_profile(Mission& m) {
  const Stopwatch watch(m.out.wall.profile_s);
  const ProfilingConfig& profiling = m.planner.config.profiling;
  std::optional<Termination> over;
  if (profiling.method == ProfilingMethod::saved) {
    m.out.belief = read_belief(profiling.file, m.planner);
  } else {
    ProfileScanner scanner(m.scene, m.planner.lidars, m.scenario.seed);
    over = scan_profile(m, scanner);
    integrate_profile(m.planner, scanner.scans(), m.bench, m.out.belief);
  }
  const auto points = m.out.belief.cloud.points_world_m();
  m.out.profile_points_world_m.assign(points.begin(), points.end());
  m.out.entropy_after_profile_nat = m.out.belief.grid.total_entropy_nat();
  m.out.distance.profile_flown_m = m.flown_m;
  m.out.profile_end_s = time_s(*m.flight);
  m.hooks.on_profile_belief(m.out.belief);
  return over;
}

/// Predicts the other half of a symmetric structure (section 2.3).
void predict(Mission& m) {
  const Stopwatch watch(m.out.wall.symmetry_s);
  Prediction& prediction = m.out.prediction;
  prediction.symmetry =
      find_symmetry(m.planner.config.symmetry, m.out.profile_points_world_m, m.out.belief.grid);
  prediction.predicted_voxels = predict_surface(prediction.symmetry, m.out.belief.grid);
  prediction.symmetry.mirrored_world_m = {};
}

/// Back to where the views begin: straight when that is clear, else over the top of the workspace.
std::optional<Termination> fly_to_first_view(Mission& m) {
  const Stopwatch watch(m.out.wall.fly_s);
  const ViewPose& goal = m.out.start;
  const double radius_m = m.planner.config.validity.collision_radius_m;
  std::vector<ViewPose> legs = {goal};
  if (!is_path_clear(m.out.belief.grid, m.current.p_world_m, goal.p_world_m, radius_m)) {
    const double top_z_m = m.planner.navigation_m.max().z();
    ViewPose climb = m.current;
    climb.p_world_m.z() = top_z_m;
    ViewPose across = goal;
    across.p_world_m.z() = top_z_m;
    legs = {climb, across, goal};
  }
  for (const ViewPose& leg : legs) {
    m.out.distance.transfer_m += (leg.p_world_m - m.current.p_world_m).norm();
    if (const auto over = fly_leg(m, leg)) return over;
  }
  m.flown_m = 0.0;
  return std::nullopt;
}

DepthFrame depth_frame(const Mission& m, std::size_t camera) {
  return sense_depth(m.scene, m.planner.cameras[camera], static_cast<int>(camera), *m.flight,
                     m.scenario.seed, m.bench.threads);
}

/// Flies to the view; cameras that run in flight are believed on the way. A frame is believed one
/// tick late, so that one due on arrival is left to the view itself.
std::optional<Termination> fly_to_view(Mission& m, const Decision& next) {
  const Stopwatch watch(m.view_wall.fly_s);
  m.entropy_before_nat = m.out.belief.grid.total_entropy_nat();
  m.out.distance.straight_m +=
      path_length_m(m.current.p_world_m, next.via_world_m, next.view.p_world_m);
  std::vector<DepthFrame> pending;
  const auto look = [&](const Flight& flight) {
    integrate_view(m.planner, pending, m.bench, m.out.belief);
    pending.clear();
    for (std::size_t i = 0; i < m.planner.cameras.size(); ++i) {
      if (is_due(m.planner.cameras[i].config.rate_hz, flight.tick())) {
        pending.push_back(depth_frame(m, i));
      }
    }
  };
  std::vector<ViewPose> legs;
  for (const Vec3& via_m : next.via_world_m) legs.push_back({via_m, next.view.yaw_rad});
  legs.push_back(next.view);
  std::optional<Termination> over;
  for (std::size_t i = 0; i < legs.size() && !over; ++i) {
    over = fly_leg(m, legs[i], m.scenario.guidance.path_speed_m_s, look);
  }
  m.out.distance.flown_m = m.flown_m;
  return over;
}

std::vector<DepthFrame> sense(Mission& m) {
  const Stopwatch watch(m.view_wall.sense_s);
  std::vector<DepthFrame> frames;
  for (std::size_t i = 0; i < m.planner.cameras.size(); ++i) frames.push_back(depth_frame(m, i));
  if (!m.hooks.on_frames) return frames;
  std::vector<ColourFrame> colours;
  for (std::size_t i = 0; i < m.planner.cameras.size(); ++i) {
    colours.push_back(sense_colour(m.scene, m.planner.cameras[i], static_cast<int>(i), *m.flight,
                                   m.bench.threads));
  }
  m.hooks.on_frames(m.out.views.size(), time_s(*m.flight), frames, colours);
  return frames;
}

void integrate(Mission& m, std::span<const DepthFrame> frames) {
  const Stopwatch watch(m.view_wall.map_s);
  integrate_view(m.planner, frames, m.bench, m.out.belief);
  remember_entropy(m.out.belief, m.entropy_before_nat, m.history);
}

void record(Mission& m, const Decision& decision) {
  m.history.decisions.push_back(decision);
  const Belief& belief = m.out.belief;
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
}

std::optional<Termination> termination(const Mission& m) {
  const TerminationConfig& config = m.planner.config.termination;
  if (m.out.views.size() >= static_cast<std::size_t>(config.max_iterations)) {
    return Termination::max_iterations;
  }
  if (entropy_has_settled(config, m.history.entropies_nat)) return Termination::entropy_change;
  if (is_back_and_forth(positions_of(m.history), config.repeated_moves)) {
    return Termination::repeated_motion;
  }
  if (should_stop(m)) return Termination::interrupted;
  return std::nullopt;
}

std::optional<Decision> decide(Mission& m) {
  const Stopwatch watch(m.view_wall.plan_s);
  const std::size_t next = m.history.decisions.size();
  if (next < m.hooks.replay.size()) return m.hooks.replay[next];
  Plan plan = plan_next_view(m.planner, m.out.belief, m.history, m.current, m.bench);
  m.hooks.on_candidates(next, plan);
  return std::move(plan.next);
}

MissionResult finish(Mission& m, Termination reason) {
  m.out.termination = reason;
  m.out.flight_time_s = time_s(*m.flight);
  m.out.energy_wh = m.flight->energy_wh();
  m.out.final_state = m.flight->state();
  return std::move(m.out);
}

/// What a baseline that asks no utility will fly, laid around the profile.
void lay_route(Mission& m) {
  const PlannerConfig& config = m.planner.config;
  if (!is_route(config.utility.name)) return;
  m.history.route = plan_route(config.utility.name, config.routes,
                               {.grid = m.out.belief.grid,
                                .navigation_m = m.planner.navigation_m,
                                .camera = m.planner.cameras.front(),
                                .start = m.out.start,
                                .views = config.termination.max_iterations});
}

}  // namespace

std::vector<CameraModel> camera_models(const Scenario& scenario) {
  std::vector<CameraModel> models;
  for (const CameraConfig& camera : scenario.cameras) models.push_back(make_camera_model(camera));
  return models;
}

MissionResult run_mission(const Scenario& scenario, const World& world, const RayScene& scene,
                          const MissionHooks& hooks, int threads) {
  Mission m(scenario, world, scene, hooks, threads);
  if (const auto over = fly_profile(m)) return finish(m, *over);
  predict(m);
  if (const auto over = fly_to_first_view(m)) return finish(m, *over);
  lay_route(m);
  Decision next = {.view = m.out.start};
  while (true) {
    if (const auto over = fly_to_view(m, next)) return finish(m, *over);
    integrate(m, sense(m));
    record(m, next);
    if (const auto over = termination(m)) return finish(m, *over);
    const std::optional<Decision> decision = decide(m);
    if (!decision) return finish(m, Termination::no_valid_view);
    next = *decision;
  }
}

}  // namespace gnbv
