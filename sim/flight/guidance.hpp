// Waypoint following through the setpoint interface, as an offboard companion computer would do it:
// what a leg and a hover ask of the vehicle, how long a leg takes, and what it draws.
#pragma once

#include <functional>
#include <span>

#include "sim/flight/smooth_path.hpp"
#include "sim/flight/trajectory.hpp"

namespace gnbv {

class Flight;
struct AirframeParameters;
struct AutopilotParameters;
struct VehicleConfig;

/// How a vehicle flies from view to view: straight legs from rest to rest, the paper; or one smooth
/// way that passes them.
enum class Trajectory { legs, smooth };

/// Acceleration and arrival are those of the released vehicle_control_iris.cpp, arrival tighter.
struct GuidanceConfig {
  Trajectory trajectory = Trajectory::legs;
  double path_speed_m_s = 2.0;
  double profile_speed_m_s = 1.0;
  double acceleration_m_s2 = 1.0;
  double jerk_m_s3 = 4.0;                    // MPC_JERK_AUTO
  double yaw_rate_rad_s = deg_to_rad(60.0);  // MPC_YAWRAUTO_MAX
  double yaw_acceleration_rad_s2 = deg_to_rad(120.0);
  double yaw_jerk_rad_s3 = deg_to_rad(480.0);
  double arrival_distance_m = 0.1;
  double arrival_yaw_rad = deg_to_rad(3.0);
  double arrival_speed_m_s = 0.05;
  double pass_distance_m = 0.6;  // smooth: a view is taken as near to it as this
  double pass_yaw_rad = deg_to_rad(15.0);
  // how fast surface may cross the image: of turns, and of speed over distance; 0: any
  double image_motion_max_rad_s = 0.0;
  double timeout_s = 60.0;  // beyond the time the reference itself needs
};

enum class LegEnd { arrived, timeout, collision, stopped };

/// A leg whose reference takes longer is not begun: fly_leg() gives it up as a timeout at once.
constexpr double kLongestLeg_s = 3600.0;

/// Flies the straight line to `goal` at up to `speed_m_s`, turning the short way meanwhile, and
/// streams setpoints every 20 ms. Returns when the reference has come to rest and the vehicle has
/// arrived (position, yaw and speed), on contact, or on timeout; the last setpoint stays in force.
/// Where the vehicle is, is what its estimate says. `vehicle` is what flies: a quadrotor is led no
/// faster than at 80 % of its autopilot's own limits, and with the feed-forward of its kind.
/// `on_tick` (may be empty) is called after every tick, for sensors that run in flight; when it
/// returns false the leg ends as `stopped`.
LegEnd fly_leg(Flight& flight, const ViewPose& goal, double speed_m_s, const GuidanceConfig& config,
               const VehicleConfig& vehicle, const std::function<bool(const Flight&)>& on_tick);

/// Flies the way from its reference number `at` on, which follows the vehicle, until it has passed
/// `poses` of its poses, or to its end. Setpoints and `on_tick` are those of fly_leg().
LegEnd fly_path(Flight& flight, std::span<const Reference> path, std::size_t& at, std::size_t poses,
                const VehicleConfig& vehicle, const std::function<bool(const Flight&)>& on_tick);

/// A quadrotor is led below its autopilot's limits.
double speed_along(const Vec3& direction, double speed_m_s, const VehicleConfig& vehicle);
/// A quadrotor turns by unequal rotors: a tenth of their command is left for it, of the 0.15 beyond
/// which the mixer gives yaw up first.
RestToRest::Limits turn_limits(const GuidanceConfig& config, const VehicleConfig& vehicle);

/// How long the reference of such a leg takes; the vehicle arrives a little later.
double leg_duration_s(const ViewPose& from, const ViewPose& goal, double speed_m_s,
                      const GuidanceConfig& config, const VehicleConfig& vehicle);

/// Where the reference is then.
Vec3 place_on_leg_m(const ViewPose& from, const ViewPose& goal, double time_s, double speed_m_s,
                    const GuidanceConfig& config, const VehicleConfig& vehicle);

/// A quadrotor comes to rest so much later than its reference (measured: 0.5 s to 1.9 s).
constexpr double kArrival_s = 2.0;

/// Energy of a leg at path speed in still air: the power at the leg's mean velocity and a thrust of
/// the weight, at least the hover power, for its duration and kArrival_s more. 0 where the vehicle
/// neither moves nor turns.
double leg_energy_wh(const VehicleConfig& vehicle, const GuidanceConfig& guidance,
                     const ViewPose& from, const ViewPose& to);

/// Energy of a descent straight down from `height_m` at PX4's slow landing speed, and of the
/// seconds that the land detector and the disarming take.
double landing_energy_wh(const VehicleConfig& vehicle, double height_m);

/// The acceleration setpoint at which the cascade, without error and integral, moves the vehicle
/// with this velocity and acceleration: the laws of the rotors and of position_control, solved for
/// it. Covers rotor drag, lost thrust, the thrust's square law and the loop's derivative term.
Vec3 acceleration_setpoint(const AirframeParameters& airframe, const AutopilotParameters& autopilot,
                           const Vec3& v_world_m_s, const Vec3& a_world_m_s2);

/// What keeps the vehicle hovering in a wind.
struct HoverTrim {
  Vec3 a_world_m_s2 = Vec3::Zero();  // PX4's acceleration setpoint
  double tilt_rad = 0.0;
  double command = 0.0;  // of each rotor
};

/// Not finite in a wind that takes all thrust from the rotors.
HoverTrim hover_trim(const VehicleConfig& vehicle, const Vec3& wind_world_m_s);

}  // namespace gnbv
