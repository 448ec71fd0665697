#include "scenarios/builtin.hpp"
#include "scenarios/fields.hpp"
#include "scenarios/presets.hpp"

namespace gnbv {
namespace {

constexpr std::array<std::string_view, 4> kUpAxes = {"auto", "x", "y", "z"};
constexpr EnumNames<VehicleKind, 2> kVehicleKinds = {
    {{VehicleKind::quadrotor, "quadrotor"}, {VehicleKind::ideal, "ideal"}}};
constexpr EnumNames<ThrustLoss, 3> kThrustLosses = {{{ThrustLoss::none, "none"},
                                                     {ThrustLoss::axial_speed, "axial_speed"},
                                                     {ThrustLoss::whole_speed, "whole_speed"}}};
constexpr EnumNames<EstimateModel, 4> kEstimateModels = {{{EstimateModel::none, "none"},
                                                          {EstimateModel::mocap, "mocap"},
                                                          {EstimateModel::gnss, "gnss"},
                                                          {EstimateModel::vio, "vio"}}};

}  // namespace

void fields(FieldVisitor& v, MeshFileConfig& c) {
  const auto of_mesh = [&]() -> FieldVisitor& { return v.only_if(!c.path.empty(), ".path"); };
  v.path("path", c.path, "Mesh file (OBJ, STL, PLY, DAE, GLTF, GLB); empty: none.");
  of_mesh().number("scale", c.scale, above_upto(0, 1e6), "Factor on the file's coordinates.");
  of_mesh().angle("yaw_deg", c.yaw_rad, between(-360, 360),
                  "Turned by this about the file's origin, counter-clockwise seen from above.");
  of_mesh().number("offset_m", c.offset_m, between(-1e8, 1e8),
                   "Added after scaling, world axes; survey coordinates are millions of metres.");
  of_mesh().choice("up_axis", c.up_axis, kUpAxes,
                   "Axis of the file that points up; auto: as the file says, z when it is silent.");
  of_mesh().number("unit_m", c.unit_m, between(0, 1e6),
                   "Metres per unit of the file; 0: as the file says, metres when it is silent.");
}

void fields(FieldVisitor& v, RotorMount& c) {
  v.number("p_body_m", c.p_body_m, between(-10, 10), "Where the rotor sits, body FLU.");
  v.number("spin", c.spin, between(-1, 1),
           "Seen from above: 1 turns counter-clockwise, -1 clockwise.");
}

void fields(FieldVisitor& v, AirframeParameters& c) {
  v.number("mass_kg", c.mass_kg, above_upto(0, 1e3), "Of the whole vehicle.");
  v.number("inertia_kg_m2", c.inertia_kg_m2, above_upto(0, 1e3), "Diagonal, body axes.");
  v.list(
      "rotors", c.rotors, {kLeastRotors, kMostRotors},
      "Four to eight rotors in any layout around the centre of mass; presets are in PX4's order.");
  v.number("thrust_coefficient_n_s2", c.thrust_coefficient_n_s2, above_upto(0, 1),
           "Thrust at rest over the square of the rotor speed.");
  v.number("moment_per_thrust_m", c.moment_per_thrust_m, between(0, 1),
           "Reaction torque over thrust at rest.");
  v.number("drag_coefficient_n_s2_per_m", c.drag_coefficient_n_s2_per_m, between(0, 1),
           "Rotor drag over rotor speed times in-plane velocity.");
  v.number("rolling_coefficient_n_s2", c.rolling_coefficient_n_s2, between(0, 1e-4),
           "Rolling moment over rotor speed times in-plane velocity.");
  v.flag("rolling_follows_spin", c.rolling_follows_spin,
         "Whether the rolling moment changes sign with the rotor's spin.");
  v.choice("thrust_loss", c.thrust_loss, kThrustLosses,
           "The speed of a rotor through the air that takes thrust from it.");
  v.number("thrust_loss_limit_m_s", c.thrust_loss_limit_m_s, above_upto(0, 1e3),
           "That speed at which no thrust is left.");
  v.number("time_constant_up_s", c.time_constant_up_s, above_upto(0, 10),
           "Of a rotor that gains speed.");
  v.number("time_constant_down_s", c.time_constant_down_s, above_upto(0, 10),
           "Of a rotor that loses speed.");
  v.number("idle_speed_rad_s", c.idle_speed_rad_s, between(0, 1e4), "Rotor speed at command 0.");
  v.number("command_gain_rad_s", c.command_gain_rad_s, above_upto(0, 1e5),
           "Rotor speed that a command of 1 adds.");
  v.number("gravity_m_s2", c.gravity_m_s2, above_upto(0, 100), "Acceleration of free fall.");
  v.number("hull_radius_m", c.hull_radius_m, above_upto(0, 10), "Of the collision cylinder.");
  v.number("hull_height_m", c.hull_height_m, above_upto(0, 10), "Of the collision cylinder.");
}

void fields(FieldVisitor& v, AutopilotParameters& c) {
  constexpr Range kGain = between(0, 1e3);
  constexpr Range kShare = between(0, 1);
  v.number("position_p_per_s", c.position_p_per_s, kGain, "MPC_XY_P, MPC_Z_P.");
  v.number("velocity_p_per_s", c.velocity_p_per_s, kGain, "MPC_XY_VEL_P_ACC, MPC_Z_VEL_P_ACC.");
  v.number("velocity_i_per_s2", c.velocity_i_per_s2, kGain, "MPC_XY_VEL_I_ACC, MPC_Z_VEL_I_ACC.");
  v.number("velocity_d", c.velocity_d, kGain, "MPC_XY_VEL_D_ACC, MPC_Z_VEL_D_ACC.");
  v.number("velocity_derivative_cutoff_hz", c.velocity_derivative_cutoff_hz, above_upto(0, 1e3),
           "MPC_VELD_LP.");
  v.number("speed_max_m_s", c.speed_max_m_s, between(0.01, 100), "MPC_XY_VEL_MAX.");
  v.number("climb_speed_max_m_s", c.climb_speed_max_m_s, between(0.01, 100), "MPC_Z_VEL_MAX_UP.");
  v.number("descent_speed_max_m_s", c.descent_speed_max_m_s, between(0.01, 100),
           "MPC_Z_VEL_MAX_DN.");
  v.angle("tilt_max_deg", c.tilt_max_rad, inside(0, 90), "MPC_TILTMAX_AIR.");
  v.number("thrust_min", c.thrust_min, kShare, "MPC_THR_MIN, of the full command.");
  v.number("thrust_max", c.thrust_max, kShare, "MPC_THR_MAX, of the full command.");
  v.number("thrust_margin_xy", c.thrust_margin_xy, kShare, "MPC_THR_XY_MARG.");
  v.number("attitude_p_per_s", c.attitude_p_per_s, kGain, "MC_ROLL_P, MC_PITCH_P, MC_YAW_P.");
  v.number("yaw_weight", c.yaw_weight, above_upto(0, 1), "MC_YAW_WEIGHT.");
  v.angle("rate_max_deg_s", c.rate_max_rad_s, between(0.1, 1e4),
          "MC_ROLLRATE_MAX, MC_PITCHRATE_MAX, MC_YAWRATE_MAX.");
  v.number("rate_p", c.rate_p, kGain, "MC_ROLLRATE_P, MC_PITCHRATE_P, MC_YAWRATE_P.");
  v.number("rate_i", c.rate_i, kGain, "MC_ROLLRATE_I, MC_PITCHRATE_I, MC_YAWRATE_I.");
  v.number("rate_d", c.rate_d, kGain, "MC_ROLLRATE_D, MC_PITCHRATE_D, MC_YAWRATE_D.");
  v.number("rate_integral_max", c.rate_integral_max, kShare, "MC_RR_INT_LIM and its twins.");
  v.angle("rate_integral_fade_deg_s", c.rate_integral_fade_rad_s, above_upto(0, 1e5),
          "Rate error beyond which nothing is integrated.");
}

void fields(FieldVisitor& v, PowerParameters& c) {
  constexpr Range kAny = between(0, 1e3);
  v.number("k1", c.k1, kAny, "Induced power (Liu et al. 2017).");
  v.number("k2", c.k2, above_upto(0, 1e3), "Induced velocity (Liu et al. 2017).");
  v.number("c2", c.c2, kAny, "Profile power (Liu et al. 2017).");
  v.number("c4", c.c4, kAny, "Parasitic power (Liu et al. 2017).");
  v.number("battery_wh", c.battery_wh, between(0, 1e5), "Usable energy; 0: never empty.");
  v.in_papers_setting().flag(
      "return_home", c.return_home,
      "Whether the mission ends at the start, landed: in time, if there is a battery.");
  v.only_if(c.return_home, ".return_home")
      .only_if(c.battery_wh > 0.0, ".battery_wh")
      .number("reserve_share", c.reserve_share, between(0, 0.9),
              "return_home: of the battery, kept beside what the way home takes.");
}

void fields(FieldVisitor& v, GnssOutage& c) {
  v.number("start_s", c.start_s, between(0, 1e6), "Of the mission's time.");
  v.number("duration_s", c.duration_s, above_upto(0, 1e6), "How long no satellite is received.");
}

void fields(FieldVisitor& v, EstimateConfig& c) {
  v.choice("model", c.model, kEstimateModels,
           "none: the truth; otherwise with the errors of motion capture, satellites or vision.");
  v.list("outages", c.outages, {0, 1000}, "gnss: times without satellites.");
  v.only_if(!c.outages.empty(), ".outages")
      .number("outage_drift_m_per_sqrt_s", c.outage_drift_m_per_sqrt_s, between(0, 100),
              "gnss: then each axis walks at random by this in a second, by twice this in four.");
}

void fields(FieldVisitor& v, VehicleConfig& c) {
  const std::string before = c.preset;
  v.choice("preset", c.preset, builtin_names("vehicles"),
           "The vehicle whose parameters hold where the keys below say nothing else.");
  if (c.preset != before) c = vehicle_preset(c.preset);
  v.choice("kind", c.kind, kVehicleKinds,
           "quadrotor: rigid body under an autopilot; ideal: moves exactly as commanded.");
  v.in_papers_setting().section("estimate", c.estimate,
                                "What the vehicle believes about its own state.");
  v.section("airframe", c.airframe, "Rigid body and rotors.");
  v.only_if(c.kind != VehicleKind::ideal, "vehicle.kind")
      .section("autopilot", c.autopilot,
               "PX4's multicopter cascade; capitals name its parameters.");
  v.section("power", c.power, "Power drawn by the rotors, and the battery.");
}

void fields(FieldVisitor& v, GuidanceConfig& c) {
  v.number("path_speed_m_s", c.path_speed_m_s, between(0.01, 50), "Top speed between views.");
  v.only_if(flies_a_profile, "planner.profiling.method")
      .number("profile_speed_m_s", c.profile_speed_m_s, between(0.01, 50),
              "Top speed of the profile's descents.");
  v.number("acceleration_m_s2", c.acceleration_m_s2, between(0.01, 50),
           "Of speeding up and braking.");
  v.number("jerk_m_s3", c.jerk_m_s3, between(0.01, 1e3), "Top rate of change of acceleration.");
  v.angle("yaw_rate_deg_s", c.yaw_rate_rad_s, between(0.1, 1e3), "Top turning speed.");
  v.angle("yaw_acceleration_deg_s2", c.yaw_acceleration_rad_s2, between(0.1, 1e4),
          "Of starting and ending a turn.");
  v.angle("yaw_jerk_deg_s3", c.yaw_jerk_rad_s3, between(0.1, 1e5),
          "Top rate of change of the turn's acceleration.");
  v.number("arrival_distance_m", c.arrival_distance_m, above_upto(0, 10),
           "Arrived: nearer to the goal than this,");
  v.angle("arrival_yaw_deg", c.arrival_yaw_rad, above_upto(0, 180),
          "Arrived: turned to the goal's yaw up to this,");
  v.number("arrival_speed_m_s", c.arrival_speed_m_s, above_upto(0, 10),
           "Arrived: slower than this.");
  v.number("timeout_s", c.timeout_s, above_upto(0, 3600),
           "A leg is given up when it takes this much longer than its reference.");
}

void fields(FieldVisitor& v, WindConfig& c) {
  v.number("mean_m_s", c.mean_world_m_s, between(-100, 100),
           "Velocity of the air, world ENU: [3, 0, 0] blows towards the east.");
  v.number("gust_w20_m_s", c.gust_w20_m_s, between(0, 100),
           "Wind 20 ft above the ground that makes Dryden's gusts: 7.7 light, 15.4 moderate, 23.2 "
           "severe; 0: none. Height is z, over terrain too.");
}

}  // namespace gnbv
