// A mission that was uploaded, as setpoints: PX4's navigator in its AUTO_MISSION mode
// (mission.cpp, mission_block.cpp), for what a multicopter flies here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/flight/commander.hpp"

namespace gnbv {

struct MissionStep {
  enum class Kind : std::uint8_t { waypoint, takeoff, land, return_home, speed, nothing };
  Kind kind = Kind::nothing;
  Vec3 p_world_m = Vec3::Constant(kNotControlled);  // an axis that is NaN: where it is by then
  bool is_above_home = false;                       // z counts from home
  double yaw_rad = kNotControlled;                  // NaN: towards the place
  double hold_s = 0.0;                              // stays this long, or for ever
  bool waits = false;                               // and then until it is told to go on
  double acceptance_m = 2.0;                        // reached: nearer than this, seen from above
  double speed_m_s = 0.0;                           // of `speed`, from then on; 0: the cruise speed
};

/// Waypoints of a vehicle that stands on the ground begin with a climb to MIS_TAKEOFF_ALT.
struct UploadedMission {
  enum class Phase : std::uint8_t { begins, climbs, goes, holds, waits, lands };
  std::vector<MissionStep> steps;
  std::size_t current = 0;
  Phase phase = Phase::begins;
  double held_s = 0.0;
  bool is_complete = false;                 // all steps done, and none begun since
  std::vector<std::uint16_t> reached = {};  // steps done that nobody took note of yet
};

enum class MissionEvent { none, over, returns_home };

/// What the vehicle does next: leads `flight` to where the current step wants it, and goes on to
/// the next step when that is done. `over` and `returns_home` leave the mission to begin anew.
MissionEvent step_mission(UploadedMission& mission, AutoFlight& flight,
                          const CommanderParameters& parameters, const VehicleState& estimate,
                          bool is_landed, double dt_s);

}  // namespace gnbv
