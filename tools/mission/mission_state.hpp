// What the stages of a mission share: its state, how a leg is flown, and when to fly home. For
// tools/mission/ only.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "planner/core/belief.hpp"
#include "planner/core/planner.hpp"
#include "planner/motion/free_space.hpp"
#include "sim/core/stopwatch.hpp"
#include "sim/flight/flight.hpp"
#include "sim/flight/guidance.hpp"
#include "tools/mission/mission.hpp"
#include "tools/mission/sensing.hpp"

namespace gnbv {

/// A place on the leg at hand from which the way home is known.
struct Exit {
  Vec3 p_world_m;
  std::vector<Vec3> way_world_m;  // the points after it; the last one is home
  double way_wh = 0.0;            // what the way takes in still air
};

/// All that a mission is at a pause: what a copy of it flies on from.
struct MissionMoment {
  MissionMoment(const Scenario& scenario, const World& world, const RayScene& scene);
  /// A copy, for a mission of that seed.
  MissionMoment(const MissionMoment& other, std::uint64_t seed);
  MissionMoment(const MissionMoment& other) : MissionMoment(other, other.model.seed) {}

  const PlannerModel model;
  MissionResult out;
  std::unique_ptr<Flight> flight;
  ProfileScanner scanner;  // of sweeps between views
  History history;
  ViewPose current;               // where the planner believes to be
  std::vector<Vec3> taken_at_m;   // each view, by what was believed
  Vec3 last_p_world_m;            // truth, one tick ago
  double gimbal_pitch_rad = 0.0;  // where it is
  double flown_m = 0.0;           // truth, since the start
  std::vector<Reference> path;    // that passes views; known to be clear to its end, where it rests
  std::size_t path_at = 0;        // of it, the reference that comes next
  std::vector<Exit> exits;        // none: home leads over the top
  std::vector<Exit> corners;      // of the way to the next view, ends included
  bool is_homing = false;         // on the last way, with energy for it
};

/// A mission under way.
struct Mission : MissionMoment {
  Mission(const Scenario& mission_scenario, const World& world, const RayScene& ray_scene,
          const MissionInputs& mission_inputs, int threads);
  /// One that flies on from there.
  Mission(const MissionMoment& from, const Scenario& mission_scenario, const RayScene& ray_scene,
          const MissionInputs& mission_inputs, int threads);

  const Scenario& scenario;
  const RayScene& scene;
  const MissionInputs& inputs;
  Scratch scratch;
  std::unique_ptr<Planner> planner;
  WallTimes view_wall;  // of the view at hand

 private:
  void ready_planner();
};

double time_s(const Flight& flight);

/// A resumed run goes on until it has caught up: stopping earlier would lose recorded views.
bool should_stop(const Mission& m);

/// After each tick: keeps the true track.
void keep_track(Mission& m);

/// Where the vehicle may fly by what is believed now: on its way home through known space alone.
FreeSpace free_space(const Mission& m);
/// To a view: as planners plan (planner.validity).
FreeSpace leg_space(const Mission& m);
/// Whether a straight leg may be flown: by what is believed (leg_space()), or where the planner
/// knows the structure by how far that is from it.
bool is_leg_free(const Mission& m, const Vec3& from_world_m, const Vec3& to_world_m);

/// Whether no body whose motion is known comes nearer than the collision radius then, so many
/// seconds from now.
bool is_clear_of_movers(const Mission& m, const Vec3& p_world_m, double in_s);

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

/// Flies one leg and keeps its track; `on_tick` runs after each tick. Waits first, where it is,
/// until no body whose motion is known will be in the way. One that no wait of a minute makes clear
/// is given up, as one that times out: then it flies to a place beside where a body comes,
/// else it stays a second.
std::optional<Termination> fly_leg(Mission& m, const ViewPose& goal, double speed_m_s,
                                   const std::function<void(const Flight&)>& on_tick);
/// At path speed, with nothing to do on the way.
std::optional<Termination> fly_leg(Mission& m, const ViewPose& goal);

/// Asked after each tick: whether a leg or a way is flown on.
bool goes_on(const Mission& m);
/// What ended a leg or a way; nothing when it arrived.
std::optional<Termination> over_after(const Mission& m, LegEnd end);

// ---- passing.cpp: to the next view by legs, or past it by one smooth way (guidance.trajectory).

/// By legs from rest to rest. Where the vehicle had to stop on a smooth way they were planned from
/// elsewhere: a view that no free leg leads to is given up, as one that times out.
std::optional<Termination> fly_legs(Mission& m, const Decision& next,
                                    const std::function<void(const Flight&)>& on_tick);
/// Flies past the view, the vehicle moving on, by a way that is clear of all that is known to be
/// occupied, and through nothing that is not known to be free; where there is none, by legs.
std::optional<Termination> fly_past(Mission& m, const Decision& next,
                                    const std::function<void(const Flight&)>& on_tick);
/// Brakes, whatever else would end the mission; says whether it collided. Where no free leg leads
/// back to where the vehicle passed the last view, it is no longer there (Mission::current).
std::optional<Termination> come_to_rest(Mission& m,
                                        const std::function<void(const Flight&)>& on_tick);

/// Profiles the structure with the LIDARs and believes the scans in one batch (section 2.2), or
/// takes up the belief that an earlier profile left; then predicts what symmetry tells of the rest
/// (section 2.3), and flies back to where the views begin.
std::optional<Termination> fly_profile(Mission& m);

// ---- homing.cpp: the battery, and the way home while it still reaches there. All by what is
// believed: the energy meter, the estimate and the map.

/// Asked after each tick: whether more is left than has to be kept. With PowerParameters::
/// return_home that is the energy of the shortest known way home, of landing there, and the
/// reserve; otherwise, and on the way home itself, that of landing where it is.
bool has_energy_to_go_on(const Mission& m);

/// The way home from the view just taken, through space known to be free when there is such a way,
/// else as it came. None for a mission that does not end at home.
std::vector<Exit> exits_here(const Mission& m);

/// Whether the view can be flown to and the vehicle come home from there; if so, the exits at all
/// corners of the way are kept. Always, when there is no battery or no way home to think of.
bool can_afford(Mission& m, const Decision& next);

/// Whether a mission that is over for this reason is still to come home: not one that has collided
/// or lost its course, and not one that is to be resumed.
bool ends_at_home(const Mission& m, Termination reason);

/// Flies home by the shortest way known and lands there; lands where it is when no more than that
/// is left. Notes how it went, and a collision as the mission's end. The energy of a landing is
/// that down to z = 0, which over a terrain below is too little.
void fly_home(Mission& m);

}  // namespace gnbv
