#include "tools/mission/mission_state.hpp"

#include "sim/flight/guidance.hpp"
#include "sim/flight/rotors.hpp"
#include "tools/mission/start_pose.hpp"

namespace gnbv {
namespace {

std::vector<LidarModel> lidar_models(const Scenario& scenario) {
  std::vector<LidarModel> models;
  for (const LidarConfig& lidar : scenario.lidars) models.push_back(make_lidar_model(lidar));
  return models;
}

/// Whether what is left in the battery is more than a straight descent to the ground takes.
bool has_energy_to_go_on(const Mission& m) {
  const VehicleConfig& vehicle = m.scenario.vehicle;
  if (vehicle.power.battery_wh <= 0.0) return true;
  const double z_m = m.flight->estimate().T_world_body.translation().z();
  return m.flight->energy_wh() + landing_energy_wh(vehicle, z_m) < vehicle.power.battery_wh;
}

/// Whether the mission may take longer.
bool has_time_to_go_on(const Mission& m) {
  const double max_s = m.planner.config.termination.max_flight_time_s;
  return max_s <= 0.0 || time_s(*m.flight) < max_s;
}

}  // namespace

std::vector<CameraModel> camera_models(const Scenario& scenario) {
  std::vector<CameraModel> models;
  for (const CameraConfig& camera : scenario.cameras) models.push_back(make_camera_model(camera));
  return models;
}

Mission::Mission(const Scenario& mission_scenario, const World& world, const RayScene& ray_scene,
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

bool should_stop(const Mission& m) {
  return m.out.views.size() >= m.hooks.replay.size() && m.hooks.should_stop();
}

double time_s(const Flight& flight) { return static_cast<double>(flight.tick()) * kTick_s; }

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
                               return has_energy_to_go_on(m) && has_time_to_go_on(m);
                             });
  if (end == LegEnd::collision) return Termination::collision;
  if (end == LegEnd::stopped) {
    return has_energy_to_go_on(m) ? Termination::max_flight_time : Termination::battery;
  }
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

}  // namespace gnbv
