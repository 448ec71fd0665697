// The vehicles by name. Besides the sources named there:
//   GZ    PX4/PX4-SITL_gazebo-classic, at 807b67b; in September 2019 at a3b8b9c
//   ROT   ethz-asl/rotors_simulator rotors_description/urdf/iris.xacro, as the authors pin it
//   PX19  PX4 1.9.2, parameter defaults and what its SITL start script (init.d-posix/rcS) sets
//   KFW   kuri-kustar/Firmware@24feea6 of 2015, posix-configs/SITL/init/rc_iris_ros
//   MRS   ctu-mrs/mrs_uav_gazebo_simulation, f450.yaml, and mrs_uav_gazebo_simulator,
//         f450.sdf.jinja
//   RFL   RflySim's default quadrotor, a bare one of 450 mm (ModelParam_uavMass 1.4, uavJ,
//         rotorCt, rotorCm, motorT; PosCtrl_tune_data.c of a model generated from it)
#include <cmath>

#include "sim/core/error.hpp"
#include "sim/flight/rotors.hpp"
#include "sim/flight/vehicle_config.hpp"

namespace gnbv {
namespace {

/// Until 1.10 PX4's velocity gains gave thrust, of the full command, instead of acceleration. Both
/// act alike when a thrust of the hover command stands for one g.
void set_velocity_gains(VehicleConfig& vehicle, const Vec3& thrust_p, const Vec3& thrust_i,
                        const Vec3& thrust_d) {
  const double m_s2_per_thrust = vehicle.airframe.gravity_m_s2 / hover_command(vehicle.airframe);
  vehicle.autopilot.velocity_p_per_s = m_s2_per_thrust * thrust_p;
  vehicle.autopilot.velocity_i_per_s2 = m_s2_per_thrust * thrust_i;
  vehicle.autopilot.velocity_d = m_s2_per_thrust * thrust_d;
}

/// Airframe: GZ 2019, models/rotors_description/urdf/iris.xacro. Autopilot: PX19.
VehicleConfig iris_sitl_2019() {
  VehicleConfig vehicle;
  vehicle.preset = "iris_sitl_2019";
  AirframeParameters& a = vehicle.airframe;
  a.mass_kg = 1.535;
  a.thrust_coefficient_n_s2 = 8.54858e-6;
  a.drag_coefficient_n_s2_per_m = 8.06428e-4;
  a.rolling_follows_spin = false;
  a.thrust_loss = ThrustLoss::whole_speed;

  AutopilotParameters& p = vehicle.autopilot;
  p.position_p_per_s = {0.8, 0.8, 1.0};
  set_velocity_gains(vehicle, {0.2, 0.2, 0.6}, {0.02, 0.02, 0.15}, {0.016, 0.016, 0.0});
  p.descent_speed_max_m_s = 1.0;
  p.attitude_p_per_s = {6.0, 6.0, 2.8};
  p.rate_p = {0.2, 0.2, 0.2};

  CommanderParameters& c = p.commander;
  c.offboard_loss_s = 0.5;                           // fixed, Commander.cpp: then LOITER
  c.offboard_loss_hold_s = 5.0;                      // rcS, COM_OF_LOSS_T
  c.offboard_loss_action = OffboardLossAction::rtl;  // rcS, COM_OBL_ACT
  c.disarm_after_landing_s = 0.1;                    // rcS
  c.descent_speed_m_s = p.descent_speed_max_m_s;     // one limit for all modes, MPC_Z_VEL_MAX_DN
  c.acceleration_m_s2 = 5.0;                         // MPC_ACC_HOR
  c.jerk_m_s3 = 8.0;                                 // MPC_JERK_AUTO
  return vehicle;
}

/// Airframe: ROT, its rotors added as point masses. Autopilot: KFW's MPC_ and MC_ parameters, in
/// today's cascade. Its start script runs the "multiplatform" controllers, a law of their own,
/// whose MPP_ and MP_ parameters (MPP_XY_VEL_P 0.01, MPP_XY_VEL_MAX 2, MP_ROLL_P 3) mean nothing in
/// this one.
VehicleConfig authors() {
  VehicleConfig vehicle;
  vehicle.preset = "authors";
  AirframeParameters& a = vehicle.airframe;
  a.mass_kg = 1.52;
  a.inertia_kg_m2 = {0.0357, 0.0462, 0.0989};
  a.thrust_coefficient_n_s2 = 8.54858e-6;
  a.moment_per_thrust_m = 0.016;
  a.drag_coefficient_n_s2_per_m = 8.06428e-5;
  a.rolling_follows_spin = false;
  a.thrust_loss = ThrustLoss::none;
  // KFW mc_mixer.cpp: speed = 600 + 150 c, c in [-1, 1], that is c = 2 command - 1
  a.idle_speed_rad_s = 450.0;
  a.command_gain_rad_s = 300.0;
  a.hull_radius_m = 0.356;  // rotor radius 0.10

  AutopilotParameters& p = vehicle.autopilot;
  p.position_p_per_s = {0.4, 0.4, 1.0};
  set_velocity_gains(vehicle, {0.2, 0.2, 0.2}, {0.02, 0.02, 0.02}, {0.005, 0.005, 0.0});
  p.speed_max_m_s = 5.0;
  p.descent_speed_max_m_s = 3.0;
  p.thrust_max = 0.9;
  p.attitude_p_per_s = {6.5, 6.5, 2.0};
  p.rate_max_rad_s.z() = deg_to_rad(60.0);
  p.rate_p = {0.15, 0.15, 0.35};
  p.rate_i = {0.05, 0.05, 0.1};
  p.commander.offboard_loss_s = 0.5;                      // KFW commander.cpp, fixed
  p.commander.tilt_max_on_ground_rad = deg_to_rad(15.0);  // MPC_TILTMAX_LND
  return vehicle;
}

/// The paper names the lab's frame, DJI F450, its autopilot (Pixhawk), computer (Jetson TX2),
/// camera (ZED Mini) and LIDAR (Hokuyo), but no mass. RFL is the bare vehicle; the payload is taken
/// as 0.5 kg in boxes of 12 cm x 12 cm x 15 cm, half of it 8 cm above the frame, half 8 cm below.
VehicleConfig f450() {
  VehicleConfig vehicle;
  vehicle.preset = "f450";
  AirframeParameters& a = vehicle.airframe;
  a.mass_kg = 1.9;  // MRS: 1.7 with an Intel NUC
  // RFL 0.0211, 0.0219, 0.0366, and the payload
  a.inertia_kg_m2 = {0.0258, 0.0266, 0.0378};
  const double arm_m = 0.225 * std::sqrt(0.5);  // wheelbase 450 mm, square
  const double height_m = 0.023;                // MRS
  a.rotors = {{{arm_m, -arm_m, height_m}, +1.0},
              {{-arm_m, arm_m, height_m}, +1.0},
              {{arm_m, arm_m, height_m}, -1.0},
              {{-arm_m, -arm_m, height_m}, -1.0}};
  a.thrust_coefficient_n_s2 = 1.105e-5;         // RFL; MRS: 1.11e-5
  a.moment_per_thrust_m = 1.779e-7 / 1.105e-5;  // RFL
  a.drag_coefficient_n_s2_per_m = 1.0e-4;       // MRS
  a.time_constant_up_s = 0.02;                  // RFL
  a.time_constant_down_s = 0.02;
  a.idle_speed_rad_s = 142.0;  // MRS: 1360 to 9068 rev/min
  a.command_gain_rad_s = 808.0;
  a.hull_radius_m = 0.352;  // 10 inch propellers (MRS)
  a.hull_height_m = 0.15;

  AutopilotParameters& p = vehicle.autopilot;  // PX4-Autopilot airframes/4011_dji_f450
  p.attitude_p_per_s = {7.0, 7.0, 2.8};
  p.rate_p = {0.15, 0.15, 0.3};
  p.rate_i = {0.05, 0.05, 0.1};
  return vehicle;
}

}  // namespace

VehicleConfig vehicle_preset(std::string_view name) {
  if (name == "iris") return {};
  if (name == "iris_sitl_2019") return iris_sitl_2019();
  if (name == "authors") return authors();
  if (name == "f450") return f450();
  throw BrokenInvariant(fmt::format("there is no vehicle preset '{}'", name));
}

}  // namespace gnbv
