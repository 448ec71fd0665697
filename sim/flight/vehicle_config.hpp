// A vehicle's parameters: rigid body, rotors, autopilot, battery. The defaults are today's Iris.
// Sources. Airframe: PX4-SITL_gazebo-classic@807b67b, models/iris/iris.sdf.jinja and
// src/gazebo_motor_model.cpp. Autopilot: PX4-Autopilot's defaults; names in capitals are PX4's.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "sim/core/pose.hpp"

namespace gnbv {

constexpr std::size_t kLeastRotors = 4;
constexpr std::size_t kMostRotors = 8;
/// One number a rotor, in the order of AirframeParameters::rotors; 0 beyond them.
using RotorValues = std::array<double, kMostRotors>;
using RotorSpeeds = RotorValues;    // rad/s, >= 0
using RotorCommands = RotorValues;  // in [0, 1]

/// Where a rotor sits, and which way it turns seen from above: +1 counter-clockwise, -1 clockwise.
struct RotorMount {
  Vec3 p_body_m = Vec3::Zero();
  double spin = 1.0;
};

/// Which speed of a rotor through the air takes thrust from it; versions of the plugin differ.
enum class ThrustLoss { none, axial_speed, whole_speed };

/// One rigid body. The origin is the centre of mass; the 5 g rotors are point masses.
struct AirframeParameters {
  double mass_kg = 1.55;
  Vec3 inertia_kg_m2 = {0.0300, 0.0295, 0.0564};  // diagonal, body axes
  std::vector<RotorMount> rotors = {{{0.13, -0.22, 0.023}, +1.0},
                                    {{-0.13, 0.20, 0.023}, +1.0},
                                    {{0.13, 0.22, 0.023}, -1.0},
                                    {{-0.13, -0.20, 0.023}, -1.0}};
  double thrust_coefficient_n_s2 = 5.84e-6;      // thrust at rest = coefficient * speed^2
  double moment_per_thrust_m = 0.06;             // reaction torque = this * thrust at rest
  double drag_coefficient_n_s2_per_m = 1.75e-4;  // drag = coefficient * speed * in-plane velocity
  double rolling_coefficient_n_s2 = 1.0e-6;      // rolling moment, same law
  bool rolling_follows_spin = true;              // the rolling moment changes sign with the spin
  ThrustLoss thrust_loss = ThrustLoss::axial_speed;
  double thrust_loss_limit_m_s = 25.0;  // thrust falls linearly to 0 at this speed
  double time_constant_up_s = 0.0125;
  double time_constant_down_s = 0.025;
  double idle_speed_rad_s = 100.0;     // armed, command 0
  double command_gain_rad_s = 1000.0;  // speed = idle + gain * command, command in [0, 1]
  double gravity_m_s2 = 9.8066;
  // Collision hull: an upright cylinder around the rotor disks, whose clearance does not change
  // with yaw. Radius: farthest rotor axis, hypot(0.13, 0.22), plus the rotor's 0.128. Height: the
  // box of iris.sdf.jinja.
  double hull_radius_m = 0.384;
  double hull_height_m = 0.11;
};

/// COM_OBL_RC_ACT, in PX4's order: what a vehicle does when its offboard stream is lost.
enum class OffboardLoss { position, altitude, stabilized, rtl, land, hold, terminate, disarm };

/// Of PX4's commander, takeoff, land detector and Auto modes.
struct CommanderParameters {
  double offboard_loss_s = 1.0;       // COM_OF_LOSS_T: the stream is lost after this silence
  double offboard_loss_hold_s = 0.0;  // COM_FAIL_ACT_T: and this long in HOLD before the action.
                                      // Today's PX4 acts at once; PX4 1.9 held for COM_OF_LOSS_T
  OffboardLoss offboard_loss_action = OffboardLoss::position;  // COM_OBL_RC_ACT

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
    commander.offboard_loss_action = static_cast<OffboardLoss>(static_cast<int>(value));
  } else {
    commander.*parameter.value = parameter.is_angle ? deg_to_rad(value) : value;
  }
  return true;
}

/// PX4's multicopter cascade, in our frames (world ENU, body FLU).
struct AutopilotParameters {
  Vec3 position_p_per_s = {0.95, 0.95, 1.0};   // MPC_XY_P, MPC_Z_P
  Vec3 velocity_p_per_s = {1.8, 1.8, 4.0};     // MPC_XY_VEL_P_ACC, MPC_Z_VEL_P_ACC
  Vec3 velocity_i_per_s2 = {0.4, 0.4, 2.0};    // MPC_XY_VEL_I_ACC, MPC_Z_VEL_I_ACC
  Vec3 velocity_d = {0.2, 0.2, 0.0};           // MPC_XY_VEL_D_ACC, MPC_Z_VEL_D_ACC
  double velocity_derivative_cutoff_hz = 5.0;  // MPC_VELD_LP
  double speed_max_m_s = 12.0;                 // MPC_XY_VEL_MAX
  double climb_speed_max_m_s = 3.0;            // MPC_Z_VEL_MAX_UP
  double descent_speed_max_m_s = 1.5;          // MPC_Z_VEL_MAX_DN
  double tilt_max_rad = deg_to_rad(45.0);      // MPC_TILTMAX_AIR
  double thrust_min = 0.12;                    // MPC_THR_MIN, of full command
  double thrust_max = 1.0;                     // MPC_THR_MAX
  double thrust_margin_xy = 0.3;               // MPC_THR_XY_MARG
  Vec3 attitude_p_per_s = {6.5, 6.5, 2.8};     // MC_ROLL_P, MC_PITCH_P, MC_YAW_P
  double yaw_weight = 0.4;                     // MC_YAW_WEIGHT
  Vec3 rate_max_rad_s = {deg_to_rad(220.0), deg_to_rad(220.0), deg_to_rad(200.0)};
  Vec3 rate_p = {0.15, 0.15, 0.2};  // MC_ROLLRATE_P, ...: command per rad/s
  Vec3 rate_i = {0.2, 0.2, 0.1};
  Vec3 rate_d = {0.003, 0.003, 0.0};
  double rate_integral_max = 0.3;                       // MC_RR_INT_LIM, ...
  double rate_integral_fade_rad_s = deg_to_rad(400.0);  // rate_control.cpp: no I beyond this error
  CommanderParameters commander;
};

/// Liu et al. 2017, fitted on an IRIS+, with thrust T, climb speed V and horizontal speed V_h:
/// P = k1 T [V/2 + sqrt((V/2)^2 + T/k2^2)] + c2 T^1.5 + c4 V_h^3.
/// Every preset keeps these coefficients: none are published for the other airframes.
struct PowerParameters {
  double k1 = 0.8554;
  double k2 = 0.3051;
  double c2 = 0.3177;
  double c4 = 0.0296;
  double battery_wh = 0.0;     // usable energy; 0: never empty
  bool return_home = false;    // the mission ends at home, landed
  double reserve_share = 0.2;  // of the battery, kept besides what the way home takes
};

/// Where the state estimate comes from. StateEstimator has the laws of the errors.
enum class EstimateModel { none, mocap, gnss, rtk, vio };

inline bool is_by_satellites(EstimateModel model) {
  return model == EstimateModel::gnss || model == EstimateModel::rtk;
}

/// The receiver has no satellites from `start_s` on, in simulated time of the mission.
struct GnssOutage {
  double start_s = 0.0;
  double duration_s = 10.0;
};

/// Satellite positioning by carrier phase. u-blox states 1 cm + 1 ppm of the way to the base
/// station (half of all errors) and, of two antennas 1 m apart, 0.4 deg of heading for its ZED-F9P,
/// at rest under an open sky. Positions here are over twice as wide, for a flight beside a
/// structure; the rates of lost fixes depend on the place (own choices).
struct RtkParameters {
  double horizontal_m = 0.02;  // sigma of each axis while fixed
  double vertical_m = 0.035;
  double heading_rad = deg_to_rad(0.4);
  double correlation_s = 40.0;  // in which these wander
  double float_m = 0.3;         // sigma of each axis that a long float solution adds
  double fixed_mean_s = 300.0;  // how long a fix lasts; both times are exponentially distributed
  double float_mean_s = 10.0;   // and how long until the next
};

struct EstimateConfig {
  EstimateModel model = EstimateModel::none;
  std::vector<GnssOutage> outages = {};  // gnss and rtk
  double outage_drift_m_per_sqrt_s = 0.3;
  RtkParameters rtk = {};
};

struct WindConfig {
  Vec3 mean_world_m_s = Vec3::Zero();  // velocity of the air: [3, 0, 0] blows towards the east
  double gust_w20_m_s = 0.0;           // wind 20 ft above the ground that makes the gusts; 0: none
};

enum class VehicleKind { quadrotor, ideal };

struct VehicleConfig {
  std::string preset = "iris";  // whose parameters are the defaults of all below
  VehicleKind kind = VehicleKind::quadrotor;
  int system_id = 1;  // MAV_SYS_ID: by which clients of `gnbv fly` tell vehicles apart
  EstimateConfig estimate;
  AirframeParameters airframe;
  AutopilotParameters autopilot;
  PowerParameters power;
};

}  // namespace gnbv
