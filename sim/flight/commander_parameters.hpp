// The parameters of PX4's commander, takeoff, land detector and Auto modes, with PX4-Autopilot's
// defaults. Names in capitals are PX4's.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

#include "sim/core/pose.hpp"

namespace gnbv {

/// COM_OBL_RC_ACT, in PX4's order: what a vehicle does when its offboard stream is lost.
enum class OffboardLossAction {
  position,
  altitude,
  stabilized,
  rtl,
  land,
  hold,
  terminate,
  disarm
};

struct CommanderParameters {
  double offboard_loss_s = 1.0;       // COM_OF_LOSS_T: the stream is lost after this silence
  double offboard_loss_hold_s = 0.0;  // COM_FAIL_ACT_T: and this long in HOLD before the action.
                                      // Today's PX4 acts at once; PX4 1.9 held for COM_OF_LOSS_T
  OffboardLossAction offboard_loss_action = OffboardLossAction::position;  // COM_OBL_RC_ACT

  double disarm_after_landing_s = 2.0;               // COM_DISARM_LAND; 0 or less: never
  double disarm_never_flown_s = 10.0;                // COM_DISARM_PRFLT; 0 or less: never
  double spool_up_s = 1.0;                           // COM_SPOOLUP_TIME
  double takeoff_ramp_s = 3.0;                       // MPC_TKO_RAMP_T
  double takeoff_altitude_m = 2.5;                   // MIS_TAKEOFF_ALT, above the ground
  double takeoff_speed_m_s = 1.5;                    // MPC_TKO_SPEED
  double tilt_max_on_ground_rad = deg_to_rad(12.0);  // MPC_TILTMAX_LND, until the takeoff is done

  double land_detection_s = 1.0;                      // LNDMC_TRIG_TIME, of all three stages
  double land_speed_vertical_max_m_s = 0.25;          // LNDMC_Z_VEL_MAX
  double land_speed_horizontal_max_m_s = 1.5;         // LNDMC_XY_VEL_MAX
  double land_rotation_max_rad_s = deg_to_rad(20.0);  // LNDMC_ROT_MAX

  double cruise_speed_m_s = 5.0;        // MPC_XY_CRUISE
  double climb_speed_m_s = 3.0;         // MPC_Z_V_AUTO_UP
  double descent_speed_m_s = 1.5;       // MPC_Z_V_AUTO_DN
  double acceleration_m_s2 = 3.0;       // MPC_ACC_HOR
  double acceleration_up_m_s2 = 4.0;    // MPC_ACC_UP_MAX
  double acceleration_down_m_s2 = 3.0;  // MPC_ACC_DOWN_MAX
  double jerk_m_s3 = 4.0;               // MPC_JERK_AUTO
  double path_error_max_m = 2.0;        // MPC_XY_ERR_MAX: a trajectory this far ahead waits
  double land_speed_m_s = 0.7;          // MPC_LAND_SPEED, below land_slow_below_m
  double land_slow_from_m = 10.0;       // MPC_LAND_ALT1: descent slows down linearly from here
  double land_slow_below_m = 5.0;       // MPC_LAND_ALT2
  double return_altitude_m = 60.0;      // RTL_RETURN_ALT, above the ground
  double return_distance_min_m = 10.0;  // RTL_MIN_DIST: nearer than this RTL climbs only into a
                                        // cone of 45 deg (RTL_CONE_ANG) above home
};

/// One of these by PX4's name. The range is that of PX4's parameter reference, or a wide one where
/// the reference gives none. COM_OF_LOSS_T begins at 0.1 s: five setpoints of a mission's stream.
struct Px4Parameter {
  std::string_view name;
  double CommanderParameters::*value;  // null: offboard_loss_action, a whole number
  double min;
  double max;
  bool is_angle = false;  // PX4 counts it in degrees
};

inline constexpr std::array<Px4Parameter, 27> kPx4Parameters = {{
    {"COM_DISARM_LAND", &CommanderParameters::disarm_after_landing_s, -1.0, 20.0},
    {"COM_DISARM_PRFLT", &CommanderParameters::disarm_never_flown_s, -1.0, 1000.0},
    {"COM_FAIL_ACT_T", &CommanderParameters::offboard_loss_hold_s, 0.0, 25.0},
    {"COM_OBL_RC_ACT", nullptr, 0.0, 7.0},
    {"COM_OF_LOSS_T", &CommanderParameters::offboard_loss_s, 0.1, 60.0},
    {"COM_SPOOLUP_TIME", &CommanderParameters::spool_up_s, 0.0, 30.0},
    {"LNDMC_ROT_MAX", &CommanderParameters::land_rotation_max_rad_s, 0.1, 1000.0, true},
    {"LNDMC_TRIG_TIME", &CommanderParameters::land_detection_s, 0.1, 10.0},
    {"LNDMC_XY_VEL_MAX", &CommanderParameters::land_speed_horizontal_max_m_s, 0.0, 100.0},
    {"LNDMC_Z_VEL_MAX", &CommanderParameters::land_speed_vertical_max_m_s, 0.0, 100.0},
    {"MIS_TAKEOFF_ALT", &CommanderParameters::takeoff_altitude_m, 0.0, 100.0},
    {"MPC_ACC_DOWN_MAX", &CommanderParameters::acceleration_down_m_s2, 2.0, 15.0},
    {"MPC_ACC_HOR", &CommanderParameters::acceleration_m_s2, 2.0, 15.0},
    {"MPC_ACC_UP_MAX", &CommanderParameters::acceleration_up_m_s2, 2.0, 15.0},
    {"MPC_JERK_AUTO", &CommanderParameters::jerk_m_s3, 1.0, 80.0},
    {"MPC_LAND_ALT1", &CommanderParameters::land_slow_from_m, 0.0, 122.0},
    {"MPC_LAND_ALT2", &CommanderParameters::land_slow_below_m, 0.0, 122.0},
    {"MPC_LAND_SPEED", &CommanderParameters::land_speed_m_s, 0.6, 10.0},
    {"MPC_TILTMAX_LND", &CommanderParameters::tilt_max_on_ground_rad, 5.0, 89.0, true},
    {"MPC_TKO_RAMP_T", &CommanderParameters::takeoff_ramp_s, 0.0, 5.0},
    {"MPC_TKO_SPEED", &CommanderParameters::takeoff_speed_m_s, 1.0, 5.0},
    {"MPC_XY_CRUISE", &CommanderParameters::cruise_speed_m_s, 3.0, 20.0},
    {"MPC_XY_ERR_MAX", &CommanderParameters::path_error_max_m, 0.1, 10.0},
    {"MPC_Z_V_AUTO_DN", &CommanderParameters::descent_speed_m_s, 0.5, 4.0},
    {"MPC_Z_V_AUTO_UP", &CommanderParameters::climb_speed_m_s, 0.5, 8.0},
    {"RTL_MIN_DIST", &CommanderParameters::return_distance_min_m, 0.5, 100.0},
    {"RTL_RETURN_ALT", &CommanderParameters::return_altitude_m, 0.0, 1000.0},
}};

/// nullptr for another name.
inline const Px4Parameter* find_px4_parameter(std::string_view name) {
  const auto* const found = std::ranges::find(kPx4Parameters, name, &Px4Parameter::name);
  return found == kPx4Parameters.end() ? nullptr : found;
}

/// In PX4's unit.
inline double px4_value(const CommanderParameters& commander, const Px4Parameter& parameter) {
  if (parameter.value == nullptr) return static_cast<double>(commander.offboard_loss_action);
  const double value = commander.*parameter.value;
  return parameter.is_angle ? rad_to_deg(value) : value;
}

/// Whether the value is in range; if so, the parameter has it.
inline bool set_px4_value(CommanderParameters& commander, const Px4Parameter& parameter,
                          double value) {
  if (!(value >= parameter.min && value <= parameter.max)) return false;
  if (parameter.value == nullptr) {
    commander.offboard_loss_action = static_cast<OffboardLossAction>(static_cast<int>(value));
  } else {
    commander.*parameter.value = parameter.is_angle ? deg_to_rad(value) : value;
  }
  return true;
}

}  // namespace gnbv
