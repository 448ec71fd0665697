#include "sim/flight/mission.hpp"

#include <cmath>

namespace gnbv {
namespace {

using Kind = MissionStep::Kind;
using Phase = UploadedMission::Phase;

/// Axes that are not said stay where the vehicle is.
Vec3 place_of(const MissionStep& step, const AutoFlight& flight, const Vec3& p_world_m) {
  Vec3 said_m = step.p_world_m;
  if (step.is_above_home) said_m.z() += flight.home_world_m.z();
  return said_m.array().isNaN().select(p_world_m, said_m);
}

/// Landings begin above their place, and takeoffs as well as waypoints from the ground with a
/// climb.
void begin_step(UploadedMission& mission, AutoFlight& flight, const CommanderParameters& parameters,
                const Vec3& p_world_m, bool is_landed) {
  const MissionStep& step = mission.steps[mission.current];
  Vec3 goal_m = place_of(step, flight, p_world_m);
  mission.is_complete = false;
  mission.held_s = 0.0;
  mission.phase = Phase::goes;
  if (step.kind == Kind::takeoff || is_landed) {
    mission.phase = Phase::climbs;
    if (step.kind != Kind::takeoff)
      goal_m.z() = std::max(goal_m.z(), flight.home_world_m.z() + parameters.takeoff_altitude_m);
    goal_m.head<2>() = p_world_m.head<2>();
  } else if (step.kind == Kind::land) {
    goal_m.z() = p_world_m.z();
  }
  go_to(flight, goal_m, step.yaw_rad);
}

/// Whether the step is done.
bool step_on(UploadedMission& mission, AutoFlight& flight, const Vec3& p_world_m, bool is_landed,
             double dt_s) {
  const MissionStep& step = mission.steps[mission.current];
  const Vec3 left_m = flight.goal_world_m - p_world_m;
  const bool is_level = std::abs(left_m.z()) < kAltitudeArrival_m;
  switch (mission.phase) {
    case Phase::begins:
    case Phase::waits:
      return false;
    case Phase::climbs:
      if (!is_level) return false;
      mission.phase = Phase::goes;
      go_to(flight, place_of(step, flight, flight.goal_world_m), step.yaw_rad);
      if (step.kind == Kind::land) flight.goal_world_m.z() = p_world_m.z();
      return false;
    case Phase::goes:
      if (!is_level || left_m.head<2>().norm() > step.acceptance_m) return false;
      mission.phase = step.kind == Kind::land ? Phase::lands : Phase::holds;
      if (step.kind == Kind::land) flight.stage = AutoFlight::Stage::land;
      return false;
    case Phase::holds:
      mission.held_s += dt_s;
      if (mission.held_s < step.hold_s || !step.waits) return mission.held_s >= step.hold_s;
      mission.reached.push_back(static_cast<std::uint16_t>(mission.current));
      mission.phase = Phase::waits;
      return false;
    case Phase::lands:
      return is_landed;
  }
  return false;
}

}  // namespace

MissionEvent step_mission(UploadedMission& mission, AutoFlight& flight,
                          const CommanderParameters& parameters, const VehicleState& estimate,
                          bool is_landed, double dt_s) {
  const Vec3 p_world_m = estimate.T_world_body.translation();
  const auto note_and_go_on = [&mission] {
    mission.reached.push_back(static_cast<std::uint16_t>(mission.current++));
    mission.phase = Phase::begins;
  };
  if (step_on(mission, flight, p_world_m, is_landed, dt_s)) note_and_go_on();
  while (mission.phase == Phase::begins && mission.current < mission.steps.size()) {
    const MissionStep& step = mission.steps[mission.current];
    if (step.kind == Kind::speed) flight.speed_m_s = step.speed_m_s;
    if (step.kind == Kind::return_home) break;
    if (step.kind == Kind::speed || step.kind == Kind::nothing) {
      note_and_go_on();
    } else {
      begin_step(mission, flight, parameters, p_world_m, is_landed);
    }
  }
  if (mission.phase != Phase::begins) return MissionEvent::none;
  const bool returns = mission.current < mission.steps.size();
  if (returns) note_and_go_on();
  mission.current = 0;
  mission.is_complete = true;
  return returns ? MissionEvent::returns_home : MissionEvent::over;
}

}  // namespace gnbv
