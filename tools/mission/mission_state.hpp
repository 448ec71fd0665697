// What the stages of a mission share: its state, and how a leg is flown. For tools/mission/ only.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "planner/core/belief.hpp"
#include "planner/core/planner.hpp"
#include "sim/core/stopwatch.hpp"
#include "sim/flight/flight.hpp"
#include "tools/mission/mission.hpp"

namespace gnbv {

/// A place on the leg at hand from which the way home is known.
struct Exit {
  Vec3 p_world_m;
  std::vector<Vec3> way_world_m;  // the points after it; the last one is home
  double way_wh = 0.0;            // what the way takes in still air
};

/// All that changes while the mission runs, beside what never does.
struct Mission {
  Mission(const Scenario& mission_scenario, const World& world, const RayScene& ray_scene,
          const MissionInputs& mission_inputs, int threads);

  const Scenario& scenario;
  const RayScene& scene;
  const MissionInputs& inputs;
  const PlannerModel model;

  Scratch scratch;

  MissionResult out;
  std::unique_ptr<Flight> flight;
  History history;
  std::unique_ptr<Planner> planner;
  ViewPose current;               // where the planner believes to be
  Vec3 last_p_world_m;            // truth, one tick ago
  double gimbal_pitch_rad = 0.0;  // where it is
  double flown_m = 0.0;           // truth, since the start
  std::vector<Exit> exits;        // none: home leads over the top
  std::vector<Exit> corners;      // of the way to the next view, ends included
  bool is_homing = false;         // on the last way, with energy for it
  WallTimes view_wall;            // of the view at hand
};

double time_s(const Flight& flight);

/// A resumed run goes on until it has caught up: stopping earlier would lose recorded views.
bool should_stop(const Mission& m);

/// After each tick: keeps the true track.
void keep_track(Mission& m);

/// Where the vehicle may fly by what is believed now.
FreeSpace free_space(const Mission& m);

/// The points from one place to another, the goal last: up to the top of the workspace, across and
/// down; where nobody may fly there, or the map has something in the way, around that; nothing when
/// no such way is known. `reads_map`: false asks of no-fly boxes alone, for an estimate.
std::optional<std::vector<Vec3>> way_over_the_top(const Mission& m, const Vec3& from_m,
                                                  const Vec3& goal_m, bool reads_map = true);

/// Tells all observers, in their order.
template <typename Event, typename... Told>
void tell(const Mission& m, Event event, const Told&... told) {
  for (MissionObserver* const observer : m.inputs.observers) (observer->*event)(told...);
}

/// Flies one leg and keeps its track; `on_tick` runs after each tick.
std::optional<Termination> fly_leg(Mission& m, const ViewPose& goal, double speed_m_s,
                                   const std::function<void(const Flight&)>& on_tick);
/// At path speed, with nothing to do on the way.
std::optional<Termination> fly_leg(Mission& m, const ViewPose& goal);

/// Profiles the structure with the LIDARs and believes the scans in one batch (section 2.2), or
/// takes up the belief that an earlier profile left; then predicts what symmetry tells of the rest
/// (section 2.3), and flies back to where the views begin.
std::optional<Termination> fly_profile(Mission& m);

}  // namespace gnbv
