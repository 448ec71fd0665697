// What PX4 decides above its cascade, as pure functions: which mode runs, how a takeoff is let go,
// when a vehicle has landed, and where the Auto modes lead it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "sim/flight/flight.hpp"
#include "sim/flight/trajectory.hpp"

namespace gnbv {

/// PX4's navigation states. There is no remote control here: the modes that need one (manual to
/// position) can be asked for, but never run.
enum class NavState {
  manual,
  stabilized,
  altitude,
  position,
  hold,  // AUTO_LOITER
  mission,
  rtl,
  takeoff,
  land,
  offboard,
  terminate
};
std::string_view name_of(NavState state);

/// PX4's custom mode (px4_custom_mode.h): main mode << 16 | sub mode << 24.
std::uint32_t custom_mode_of(NavState state);
/// The reverse, for the modes that can be asked for; sub modes are those of the Auto modes.
std::optional<NavState> nav_state_of(long main_mode, long sub_mode);

/// Landing, returning and termination refuse arming (mode_req_prevent_arming).
bool prevents_arming(NavState mode);

/// Whether a mode can run (mode_requirements.cpp) when the last valid offboard setpoint came that
/// long ago. Estimates never fail here; a mission Px4 knows of, not this.
bool can_run(NavState mode, double offboard_silence_s, const CommanderParameters& parameters);

/// The mode of an armed vehicle that was told `intention` (failsafe.cpp, framework.cpp); nothing
/// when it disarms. It follows the intention again as soon as that can run. Until then it holds: of
/// PX4's fallbacks (position, altitude, stabilized, hold, ...) those before hold need a remote
/// control. A lost offboard stream has a fallback of its own, OffboardLoss.
std::optional<NavState> choose_mode(NavState intention, double offboard_silence_s,
                                    const CommanderParameters& parameters);

enum class TakeoffPhase { disarmed, spool_up, ready, ramp, flight };

/// PX4's smooth takeoff (Takeoff.cpp): armed rotors spool up, wait until somebody wants to fly, and
/// are let go along a ramp of the climb limit.
struct Takeoff {
  TakeoffPhase phase = TakeoffPhase::disarmed;
  double spooled_s = 0.0;  // since arming
  double ramp_share = 0.0;
};

/// One step of `dt_s`. A landing puts the vehicle back to `ready`, disarming to `disarmed`.
Takeoff next(const Takeoff& takeoff, const CommanderParameters& parameters, bool is_armed,
             bool is_landed, bool wants_takeoff, double dt_s);

/// The climb limit, towards `climb_max_m_s`. The ramp begins at the downward velocity -g / P at
/// which the velocity loop (gain `velocity_p_per_s`) gives no thrust.
double climb_limit_m_s(const Takeoff& takeoff, double gravity_m_s2, double velocity_p_per_s,
                       double climb_max_m_s);

/// PX4's land detector (MulticopterLandDetector.cpp): three stages. The condition of each has to
/// hold for a third of LNDMC_TRIG_TIME before the next can begin.
struct LandDetector {
  double contact_s = 0.0;  // how long the condition of each stage has held
  double maybe_s = 0.0;
  double landed_s = 0.0;
  bool has_ground_contact = false;  // told to descend, little thrust, and not moving
  bool is_maybe_landed = false;     // no thrust, and not turning
  bool is_landed = false;
};

/// The detector of a vehicle that stands on the ground.
constexpr LandDetector kOnGround = {0.0, 0.0, 0.0, true, true, true};

struct LandEvidence {
  bool is_armed = false;
  bool is_told_to_descend = false;  // velocity setpoint below -0.3 m/s
  double thrust = 0.0;              // command, of [0, 1]
  double thrust_min = 0.0;
  double hover_thrust = 0.5;
};

/// One step of `dt_s`. A disarmed vehicle counts as landed at once.
LandDetector next(const LandDetector& detector, const CommanderParameters& parameters,
                  const LandEvidence& evidence, const VehicleState& estimate, double dt_s);

/// What an Auto mode remembers: PX4's hold, takeoff, land and return as setpoints along
/// jerk-limited trajectories (FlightTaskAuto.cpp, PositionSmoothing.cpp, rtl.cpp). The heading
/// stays that of the mode's begin but on the way to a place; PX4 would also turn towards home.
struct AutoFlight {
  enum class Stage { hold, climb, go_home, go_to, land };
  Stage stage = Stage::hold;
  NavState mode = NavState::hold;
  std::array<Motion, 3> axes;  // the trajectory, world ENU
  double yaw_rad = 0.0;
  double altitude_m = 0.0;               // that `climb` ends at, world z
  Vec3 home_world_m = Vec3::Zero();      // on the ground
  Vec3 goal_world_m = Vec3::Zero();      // of `go_to`
  double goal_yaw_rad = kNotControlled;  // NaN: as it is
  double speed_m_s = 0.0;                // over ground; 0: MPC_XY_CRUISE
};

/// NAV_MC_ALT_RAD: this near an altitude is there; the rest of the way is flown as well.
constexpr double kAltitudeArrival_m = 0.8;

/// From now on straight to that place, where it stays; `yaw_rad` NaN: facing the way, where it is
/// longer than NAV_ACC_RAD.
void go_to(AutoFlight& flight, const Vec3& goal_world_m, double yaw_rad);

/// Begins a mode where the vehicle is and with the velocity it has. `altitude_m`: that of a
/// takeoff, above home; a vehicle that is higher stays there.
AutoFlight begin_auto(NavState mode, const CommanderParameters& parameters,
                      const VehicleState& estimate, const Vec3& home_world_m, double altitude_m);

/// The setpoint `dt_s` after the last.
Setpoint step_auto(AutoFlight& flight, const CommanderParameters& parameters,
                   const VehicleState& estimate, double dt_s);

/// Whether a takeoff has come near its altitude (NAV_MC_ALT_RAD).
bool is_finished(const AutoFlight& takeoff, const VehicleState& estimate);

}  // namespace gnbv
