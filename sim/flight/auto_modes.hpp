// PX4's Auto modes without a mission (hold, takeoff, land, return) as setpoints along jerk-limited
// trajectories (FlightTaskAuto.cpp, PositionSmoothing.cpp, rtl.cpp).
#pragma once

#include <array>

#include "sim/flight/commander.hpp"
#include "sim/flight/trajectory.hpp"

namespace gnbv {

/// What an Auto mode remembers. The heading stays that of the mode's begin; PX4 would turn towards
/// home on the way back.
struct AutoFlight {
  enum class Stage { hold, climb, go_home, land };
  Stage stage = Stage::hold;
  NavState mode = NavState::hold;
  std::array<Motion, 3> axes;  // the trajectory, world ENU
  double yaw_rad = 0.0;
  double altitude_m = 0.0;  // that `climb` ends at, world z
  Eigen::Vector2d home_world_m = Eigen::Vector2d::Zero();
};

/// Begins a mode where the vehicle is and with the velocity it has. `altitude_m`: that of a
/// takeoff, above the ground (world z = 0); a vehicle that is higher stays there.
AutoFlight begin_auto(NavState mode, const CommanderParameters& parameters,
                      const VehicleState& estimate, const Eigen::Vector2d& home_world_m,
                      double altitude_m);

/// The setpoint `dt_s` after the last.
Setpoint step_auto(AutoFlight& flight, const CommanderParameters& parameters,
                   const VehicleState& estimate, double dt_s);

/// Whether a takeoff has come near its altitude (NAV_MC_ALT_RAD).
bool is_finished(const AutoFlight& takeoff, const VehicleState& estimate);

}  // namespace gnbv
