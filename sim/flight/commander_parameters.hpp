// What PX4's commander, takeoff, land detector and Auto modes are set to; capitals name PX4's
// parameters. PX4-Autopilot's defaults.
#pragma once

#include "sim/core/pose.hpp"

namespace gnbv {

/// COM_OBL_RC_ACT, in PX4's order: what a vehicle does whose offboard stream is lost.
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
  double offboard_loss_hold_s = 0.0;  // stays in HOLD this long before the action: 0 today; PX4 1.9
                                      // held at 0.5 s and acted COM_OF_LOSS_T later
  OffboardLossAction offboard_loss_action = OffboardLossAction::position;  // COM_OBL_RC_ACT

  double disarm_after_landing_s = 2.0;               // COM_DISARM_LAND
  double disarm_never_flown_s = 10.0;                // COM_DISARM_PRFLT
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

}  // namespace gnbv
