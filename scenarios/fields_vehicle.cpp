#include "scenarios/builtin.hpp"
#include "scenarios/calibration.hpp"
#include "scenarios/fields.hpp"

namespace gnbv {
namespace {

/// The first key of a sensor: another preset brings its values, which the keys after it override.
template <typename Config>
void preset(const Keys& key, Config& c, std::string_view folder) {
  const std::string before = c.preset;
  key("preset", c.preset, builtin_names(folder),
      "Sets all values but name and mounting to those of this sensor.");
  if (c.preset != before) c = with_preset_values(c);
}

template <typename Config>
void mounting(const Keys& key, Config& c) {
  constexpr Range kPitch_deg = {-90, 90};
  constexpr std::string_view kPitch = "Turn about body y, made second; positive tilts down.";
  key("p_body_m", c.p_body_m, {-10, 10},
      "Where the sensor sits, in the body's axes: forward, left, up.");
  key.angle("roll_deg", c.roll_rad, {-180, 180}, "Turn about body x, made first.");
  if constexpr (std::is_same_v<Config, CameraConfig>) {
    key.angle_or_section("pitch_deg", c.pitch_rad, kPitch_deg, c.gimbal, kPitch,
                         "A gimbal: the pitches that every view may choose from.");
    if (c.gimbal) c.pitch_rad = nearest_pitch_rad(*c.gimbal, 0.0);
  } else {
    key.angle("pitch_deg", c.pitch_rad, kPitch_deg, kPitch);
  }
  key.angle("yaw_deg", c.yaw_rad, {-180, 180},
            "Turn about body z, made last; positive turns left.");
}

}  // namespace

void fields(const Keys& key, RotorMount& c) {
  key("p_body_m", c.p_body_m, {-10, 10},
      "Where the rotor sits, in the body's axes: forward, left, up.");
  key("spin", c.spin, {-1, 1}, "Seen from above: 1 turns counter-clockwise, -1 clockwise.");
}

void fields(const Keys& key, AirframeParameters& c) {
  key("mass_kg", c.mass_kg, positive(1e3), "Mass of the whole vehicle.");
  key("inertia_kg_m2", c.inertia_kg_m2, positive(1e3),
      "Diagonal of the inertia, in the body's axes.");
  key.list("rotors", c.rotors, {kLeastRotors, kMostRotors},
           "Four to eight, in any layout around the centre of mass; presets are in PX4's order.");
  key("thrust_coefficient_n_s2", c.thrust_coefficient_n_s2, positive(1),
      "Thrust at rest, divided by the square of the rotor speed.");
  key("moment_per_thrust_m", c.moment_per_thrust_m, {0, 1},
      "Reaction torque, divided by thrust, at rest.");
  key("drag_coefficient_n_s2_per_m", c.drag_coefficient_n_s2_per_m, {0, 1},
      "Rotor drag, divided by rotor speed times in-plane velocity.");
  key("rolling_coefficient_n_s2", c.rolling_coefficient_n_s2, {0, 1e-4},
      "Rolling moment, divided by rotor speed times in-plane velocity.");
  key("rolling_follows_spin", c.rolling_follows_spin,
      "Whether the rolling moment changes sign with the rotor's spin.");
  using enum ThrustLoss;
  key("thrust_loss", c.thrust_loss,
      {{none, "none"}, {axial_speed, "axial_speed"}, {whole_speed, "whole_speed"}},
      "Which speed of a rotor through the air takes thrust from it.");
  key("thrust_loss_limit_m_s", c.thrust_loss_limit_m_s, positive(1e3),
      "The speed at which no thrust is left.");
  key("time_constant_up_s", c.time_constant_up_s, positive(10),
      "Time constant of a rotor that gains speed.");
  key("time_constant_down_s", c.time_constant_down_s, positive(10),
      "Time constant of a rotor that loses speed.");
  key("idle_speed_rad_s", c.idle_speed_rad_s, {0, 1e4}, "Rotor speed at command 0.");
  key("command_gain_rad_s", c.command_gain_rad_s, positive(1e5), "Rotor speed added by command 1.");
  key("gravity_m_s2", c.gravity_m_s2, positive(100), "Acceleration of free fall.");
  key("hull_radius_m", c.hull_radius_m, positive(10), "Radius of the collision cylinder.");
  key("hull_height_m", c.hull_height_m, positive(10), "Height of the collision cylinder.");
}

void fields(const Keys& key, CommanderParameters& c) {
  key("offboard_loss_s", c.offboard_loss_s, {0.1, 60},
      "COM_OF_LOSS_T: a client that is silent for longer is lost.");
}

void fields(const Keys& key, AutopilotParameters& c) {
  constexpr Range kGain = {0, 1e3};
  constexpr Range kShare = {0, 1};
  key("position_p_per_s", c.position_p_per_s, kGain, "MPC_XY_P, MPC_Z_P.");
  key("velocity_p_per_s", c.velocity_p_per_s, kGain, "MPC_XY_VEL_P_ACC, MPC_Z_VEL_P_ACC.");
  key("velocity_i_per_s2", c.velocity_i_per_s2, kGain, "MPC_XY_VEL_I_ACC, MPC_Z_VEL_I_ACC.");
  key("velocity_d", c.velocity_d, kGain, "MPC_XY_VEL_D_ACC, MPC_Z_VEL_D_ACC.");
  key("velocity_derivative_cutoff_hz", c.velocity_derivative_cutoff_hz, positive(1e3),
      "MPC_VELD_LP.");
  key("speed_max_m_s", c.speed_max_m_s, {0.01, 100}, "MPC_XY_VEL_MAX.");
  key("climb_speed_max_m_s", c.climb_speed_max_m_s, {0.01, 100}, "MPC_Z_VEL_MAX_UP.");
  key("descent_speed_max_m_s", c.descent_speed_max_m_s, {0.01, 100}, "MPC_Z_VEL_MAX_DN.");
  key.angle("tilt_max_deg", c.tilt_max_rad, inside(0, 90), "MPC_TILTMAX_AIR.");
  key("thrust_min", c.thrust_min, kShare, "MPC_THR_MIN, of the full command.");
  key("thrust_max", c.thrust_max, kShare, "MPC_THR_MAX, of the full command.");
  key("thrust_margin_xy", c.thrust_margin_xy, kShare, "MPC_THR_XY_MARG.");
  key("attitude_p_per_s", c.attitude_p_per_s, kGain, "MC_ROLL_P, MC_PITCH_P, MC_YAW_P.");
  key("yaw_weight", c.yaw_weight, positive(1), "MC_YAW_WEIGHT.");
  key.angle("rate_max_deg_s", c.rate_max_rad_s, {0.1, 1e4},
            "MC_ROLLRATE_MAX, MC_PITCHRATE_MAX, MC_YAWRATE_MAX.");
  key("rate_p", c.rate_p, kGain, "MC_ROLLRATE_P, MC_PITCHRATE_P, MC_YAWRATE_P.");
  key("rate_i", c.rate_i, kGain, "MC_ROLLRATE_I, MC_PITCHRATE_I, MC_YAWRATE_I.");
  key("rate_d", c.rate_d, kGain, "MC_ROLLRATE_D, MC_PITCHRATE_D, MC_YAWRATE_D.");
  key("rate_integral_max", c.rate_integral_max, kShare, "MC_RR_INT_LIM and its twins.");
  key.angle("rate_integral_fade_deg_s", c.rate_integral_fade_rad_s, positive(1e5),
            "Rate error beyond which nothing is integrated.");
  key.section("commander", c.commander, "What clients may also set, by PX4's names.");
}

void fields(const Keys& key, PowerParameters& c) {
  constexpr Range kAny = {0, 1e3};
  key("k1", c.k1, kAny, "Induced power (Liu et al. 2017).");
  key("k2", c.k2, positive(1e3), "Induced velocity (Liu et al. 2017).");
  key("c2", c.c2, kAny, "Profile power (Liu et al. 2017).");
  key("c4", c.c4, kAny, "Parasitic power (Liu et al. 2017).");
  key("battery_wh", c.battery_wh, {0, 1e5}, "Usable energy; 0: never empty.");
  key.of_papers_setting()("return_home", c.return_home,
                          "The mission ends with a flight home and a landing at the start; with a "
                          "battery, while the energy is enough.");
  key.only_if(c.return_home, ".return_home")
      .only_if(c.battery_wh > 0.0, ".battery_wh")(
          "reserve_share", c.reserve_share, {0, 0.9},
          "return_home: share of the battery that is kept, beyond what the way home takes.");
}

void fields(const Keys& key, GnssOutage& c) {
  key("start_s", c.start_s, {0, 1e6}, "When it begins, in the mission's time.");
  key("duration_s", c.duration_s, positive(1e6), "How long no satellite is received.");
}

void fields(const Keys& key, RtkParameters& c) {
  constexpr Range kSigma_m = {0, 100};
  key("horizontal_m", c.horizontal_m, kSigma_m, "Standard deviation of x and of y while fixed.");
  key("vertical_m", c.vertical_m, kSigma_m, "The same of z.");
  key.angle("heading_deg", c.heading_rad, {0, 90}, "The same of the heading, from two antennas.");
  key("correlation_s", c.correlation_s, {0.1, 1e6}, "Correlation time of these errors.");
  key("float_m", c.float_m, kSigma_m,
      "Standard deviation that a long float solution adds to each axis.");
  key("fixed_mean_s", c.fixed_mean_s, {0.1, 1e9}, "Mean time until the fix is lost.");
  key("float_mean_s", c.float_mean_s, {0.1, 1e6}, "Mean time until it is back.");
}

void fields(const Keys& key, EstimateConfig& c) {
  using enum EstimateModel;
  key("model", c.model,
      {{none, "none"}, {mocap, "mocap"}, {gnss, "gnss"}, {rtk, "rtk"}, {vio, "vio"}},
      "Where the vehicle believes itself to be. none: where it truly is; otherwise with the errors "
      "of motion capture, satellites (rtk: by phase) or vision.");
  key.list("outages", c.outages, {0, 1000}, "gnss, rtk: times without satellites.");
  key.only_if(!c.outages.empty(), ".outages")(
      "outage_drift_m_per_sqrt_s", c.outage_drift_m_per_sqrt_s, {0, 100},
      "Without satellites each axis drifts at random: by this in 1 s, by twice this in 4 s.");
  key.only_if(c.model == rtk, ".model").section("rtk", c.rtk, "rtk: how good the fixes are.");
}

void fields(const Keys& key, VehicleConfig& c) {
  const std::string before = c.preset;
  key("preset", c.preset, builtin_names("vehicles"),
      "Sets all other values of the vehicle to those of this one.");
  if (c.preset != before) c = vehicle_preset(c.preset);
  key("kind", c.kind, {{VehicleKind::quadrotor, "quadrotor"}, {VehicleKind::ideal, "ideal"}},
      "quadrotor: rigid body under an autopilot; ideal: moves exactly as commanded.");
  key("system_id", c.system_id, {1, 250}, "MAV_SYS_ID of `gnbv fly`, one for each vehicle.");
  key.of_papers_setting().section("estimate", c.estimate, "What the vehicle knows of itself.");
  key.section("airframe", c.airframe, "Rigid body and rotors.");
  key.only_if(c.kind != VehicleKind::ideal, "vehicle.kind")
      .section("autopilot", c.autopilot,
               "PX4's multicopter cascade; capitals name its parameters.");
  key.section("power", c.power, "Power drawn by the rotors, and the battery.");
}

void fields(const Keys& key, GuidanceConfig& c) {
  using enum Trajectory;
  key.of_papers_setting()("trajectory", c.trajectory, {{legs, "legs"}, {smooth, "smooth"}},
                          "legs: straight from view to view, with a stop at each; smooth: a way "
                          "that passes the views.");
  key("path_speed_m_s", c.path_speed_m_s, {0.01, 50}, "Top speed between views.");
  const Keys profiling = key.only_if(flies_a_profile, "planner.profiling.method");
  profiling("profile_speed_m_s", c.profile_speed_m_s, {0.01, 50},
            "Top speed while the LIDARs scan the profile.");
  key("acceleration_m_s2", c.acceleration_m_s2, {0.01, 50},
      "Acceleration when speeding up and braking.");
  key("jerk_m_s3", c.jerk_m_s3, {0.01, 1e3}, "Top rate of change of acceleration.");
  key.angle("yaw_rate_deg_s", c.yaw_rate_rad_s, {0.1, 1e3}, "Top turning speed.");
  key.angle("yaw_acceleration_deg_s2", c.yaw_acceleration_rad_s2, {0.1, 1e4},
            "Top acceleration of a turn.");
  key.angle("yaw_jerk_deg_s3", c.yaw_jerk_rad_s3, {0.1, 1e5}, "Top jerk of a turn.");
  key("arrival_distance_m", c.arrival_distance_m, positive(10),
      "To have arrived, the vehicle must be nearer than this.");
  key.angle("arrival_yaw_deg", c.arrival_yaw_rad, positive(180),
            "To have arrived, the vehicle must be turned to within this.");
  key("arrival_speed_m_s", c.arrival_speed_m_s, positive(10),
      "To have arrived, the vehicle must be slower than this.");
  const Keys passing = key.only_if(c.trajectory == smooth, ".trajectory");
  passing("pass_distance_m", c.pass_distance_m, positive(10),
          "smooth: how near to a view the way passes.");
  passing.angle("pass_yaw_deg", c.pass_yaw_rad, positive(180),
                "smooth: how far the heading may be off there.");
  key.angle("image_motion_max_deg_s", c.image_motion_max_rad_s, {0, 1e3},
            "How fast surface may cross the image. It limits turns, and between views the speed "
            "divided by the distance of the nearest known surface. Set it to 57.3 times the blur "
            "allowed in pixels / (focal length in pixels * exposure time in s). 0: no limit.");
  key("timeout_s", c.timeout_s, positive(3600),
      "A leg that takes this much longer than planned is given up.");
}

void fields(const Keys& key, WindConfig& c) {
  key("mean_m_s", c.mean_world_m_s, {-100, 100},
      "Velocity of the air, world ENU: [3, 0, 0] blows towards the east.");
  key("gust_w20_m_s", c.gust_w20_m_s, {0, 100},
      "Wind 20 ft above the ground, for Dryden's gusts: 7.7 light, 15.4 moderate, 23.2 severe; 0: "
      "no gusts. Height is z, also over terrain.");
}

void fields(const Keys& key, DepthNoiseConfig& c) {
  using enum DepthNoise;
  key("model", c.model,
      {{none, "none"},
       {released, "released"},
       {khoshelham, "khoshelham"},
       {nguyen, "nguyen"},
       {stereo, "stereo"}},
      "How the standard deviation grows with depth (sensors/depth_noise.hpp).");
  const Keys of_stereo = key.only_if(c.model == stereo, ".model");
  of_stereo("baseline_m", c.baseline_m, {1e-3, 10}, "stereo: distance between the two lenses.");
  of_stereo("disparity_noise_px", c.disparity_noise_px, {0, 10},
            "stereo: standard deviation of the disparity.");
}

void fields(const Keys& key, DistortionConfig& c) {
  using enum Distortion;
  constexpr Range kAny = {-1e6, 1e6};
  key("model", c.model,
      {{none, distortion_name(none)},
       {brown_conrady, distortion_name(brown_conrady)},
       {kannala_brandt, distortion_name(kannala_brandt)}},
      "A model of OpenCV's: brown_conrady, with k4 to k6 of the rational model; or kannala_brandt, "
      "a fisheye. A fisheye's ranges count along the ray.");
  const Keys distorted = key.only_if(c.model != none, ".model");
  const Keys brown = distorted.only_if(c.model == brown_conrady, ".model");
  distorted("k1", c.k1, kAny, "Radial coefficient of the second power.");
  distorted("k2", c.k2, kAny, "Radial coefficient of the fourth power.");
  distorted("k3", c.k3, kAny, "Radial coefficient of the sixth power.");
  distorted("k4", c.k4, kAny,
            "brown_conrady: the divisor's coefficient of the second power; kannala_brandt: of the "
            "eighth power.");
  brown("k5", c.k5, kAny, "brown_conrady: the divisor's coefficient of the fourth power.");
  brown("k6", c.k6, kAny, "brown_conrady: the divisor's coefficient of the sixth power.");
  brown("p1", c.p1, kAny,
        "brown_conrady: first tangential coefficient, for a lens off its centre.");
  brown("p2", c.p2, kAny,
        "brown_conrady: second tangential coefficient, for a lens off its centre.");
  distorted.angle("max_angle_deg", c.max_angle_rad, {1, 85},
                  "What lies farther off the optical axis is not seen.");
}

void fields(const Keys& key, GimbalConfig& c) {
  key.angle("min", c.min_rad, {-90, 90}, "The first pitch, degrees; negative looks up.");
  key.angle("max", c.max_rad, {-90, 90}, "No pitch is above this.");
  key.angle("step", c.step_rad, {1, 180}, "Step from one pitch to the next.");
}

void fields(const Keys& key, CameraConfig& c) {
  preset(key, c, "cameras");
  key.word("name", c.name, "Name of the camera, unlike that of any other.");
  key("width_px", c.width_px, {1, 8192}, "Pixels per row.");
  key("height_px", c.height_px, {1, 8192}, "Pixels per column.");
  std::string calibration;
  key.path("calibration", calibration,
           "Calibration file of OpenCV, Kalibr (FILE#cam1: its second camera) or ROS camera_info. "
           "It sets image size, focal lengths, centre and distortion; a run keeps these values, "
           "not the file.");
  try {
    if (!calibration.empty()) c = calibrated(calibration, c);
  } catch (const BadInput& wrong) {
    key.refuse("calibration", wrong.what());
  }
  const Keys of_angles = key.only_if(c.fx_px == 0.0, ".fx_px");
  of_angles.angle("fov_x_deg", c.fov_x_rad, {1, 170},
                  "Horizontal field of view; given alone, pixels are square.");
  of_angles.only_if(c.fy_px == 0.0, ".fy_px")
      .angle("fov_y_deg", c.fov_y_rad, {1, 170},
             "Vertical field of view; given alone, pixels are square.");
  key("fx_px", c.fx_px, {0, 1e6},
      "Focal length along a row; 0: it follows from the field of view.");
  key("fy_px", c.fy_px, {0, 1e6}, "Focal length along a column; 0: as fx_px.");
  key("cx_px", c.cx_px, {0, 8192},
      "Column of the optical axis, where the first pixel's centre is 0.5; 0: the image's middle.");
  key("cy_px", c.cy_px, {0, 8192}, "Row of the optical axis; 0: the image's middle.");
  key("skew_px", c.skew_px, {-1e4, 1e4},
      "Skew of the camera matrix: how many columns a point moves that lies one focal length down "
      "the image.");
  key.section("distortion", c.distortion, "Of the lens.");
  key("range_min_m", c.range_min_m, {0, 1e3},
      "Least range, along the optical axis; a nearer return is invalid.");
  key("range_max_m", c.range_max_m, positive(1e3),
      "Greatest range, along the optical axis; nothing returns from farther away.");
  key("return_max_m", c.return_max_m, {0, 1e3},
      "Surface deeper than this gives no return; planner.map.no_return says what that means. 0: "
      "all surface up to range_max_m returns.");
  key("rate_hz", c.rate_hz, {0, 250},
      "Frames per second in flight, at most one per tick; 0: one at each view, none in flight.");
  key("drop_probability", c.drop_probability, {0, 1},
      "Probability that a frame is lost, at a view or in flight.");
  mounting(key, c);
  key.section("noise", c.noise, "Noise of the depth.");
}

void fields(const Keys& key, LidarConfig& c) {
  preset(key, c, "lidars");
  key.word("name", c.name, "Name of the LIDAR, unlike that of any other.");
  using enum LidarPattern;
  using enum LidarLooks;
  key("pattern", c.pattern, {{fan, "fan"}, {spinning, "spinning"}, {rosette, "rosette"}},
      "fan: one plane; spinning: rings; rosette: other points in each sweep.");
  key("looks", c.looks, {{profile, "profile"}, {views, "views"}, {flight, "flight"}},
      "profile: scans that alone; views: a sweep at each view, too; flight: and at rate_hz on the "
      "way. Without cameras profile is views.");
  key("beams", c.beams, {1, 1e5}, "Beams per sweep, of a fan spread evenly; spinning: per ring.");
  key.only_if(c.pattern == spinning, ".pattern")(
      "rings", c.rings, {1, 256}, "spinning: evenly from the lowest elevation to the highest.");
  const Keys high = key.only_if(c.pattern != fan, ".pattern");
  high.angle("elevation_min_deg", c.elevation_min_rad, {-80, 80}, "Of the lowest beam.");
  high.angle("elevation_max_deg", c.elevation_max_rad, {-80, 80}, "Of the highest beam.");
  key.angle("fov_deg", c.fov_rad, {0, 360}, "Angle from the first beam to the last.");
  key("rate_hz", c.rate_hz, positive(250), "Sweeps per second, at most one per tick.");
  key("range_min_m", c.range_min_m, {0, 1e3}, "Nearer returns are invalid.");
  key("range_max_m", c.range_max_m, positive(1e3), "Beyond there is no return.");
  mounting(key, c);
  key("range_sigma_m", c.range_sigma_m, {0, 10}, "Standard deviation of a range.");
  key("rolling", c.rolling, "Whether the beams of a sweep follow one another; false: all at once.");
}

}  // namespace gnbv
