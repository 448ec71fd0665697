// A vehicle's parameters: rigid body, rotors, autopilot, battery. The defaults are today's Iris.
// Sources. Airframe: PX4-SITL_gazebo-classic@807b67b, models/iris/iris.sdf.jinja and
// src/gazebo_motor_model.cpp. Autopilot: PX4-Autopilot's defaults; names in capitals are PX4's.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "sim/core/pose.hpp"
#include "sim/flight/commander_parameters.hpp"

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
enum class EstimateModel { none, mocap, gnss, vio };

/// The receiver has no satellites from `start_s` on, in simulated time of the mission.
struct GnssOutage {
  double start_s = 0.0;
  double duration_s = 10.0;
};

struct EstimateConfig {
  EstimateModel model = EstimateModel::none;
  std::vector<GnssOutage> outages = {};  // gnss only
  double outage_drift_m_per_sqrt_s = 0.3;
};

enum class VehicleKind { quadrotor, ideal };

struct VehicleConfig {
  std::string preset = "iris";  // whose parameters are the defaults of all below
  VehicleKind kind = VehicleKind::quadrotor;
  EstimateConfig estimate;
  AirframeParameters airframe;
  AutopilotParameters autopilot;
  PowerParameters power;
};

}  // namespace gnbv
