#include "sim/flight/guidance.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/core/error.hpp"
#include "sim/flight/flight.hpp"
#include "sim/flight/rotors.hpp"

namespace gnbv {
namespace {

constexpr int kTicksPerSetpoint = 5;
static_assert(kTicksPerSetpoint * kTick_s == kReference_s);
constexpr double kShareOfLimit = 0.8;  // of the autopilot's, so that its loops can still correct

/// How much later than the setpoint the tilt follows. A loop of gain P follows a long ramp 1 / P
/// later; those of a leg are short: with 0.8 of it the presets deviate and overshoot least on the
/// whole (measured, in steps of a tenth).
double attitude_lag_s(const AutopilotParameters& autopilot) {
  return 0.8 / autopilot.attitude_p_per_s.x();
}

/// `ahead`: the reference attitude_lag_s() later. What the tilt needs is sent ahead of it by its
/// lag, what the rotors need at once.
Setpoint setpoint_of(const Reference& now, const Reference& ahead, const VehicleConfig& vehicle) {
  const auto wanted_at = [&](const Reference& then) {
    return acceleration_setpoint(vehicle.airframe, vehicle.autopilot, then.v_world_m_s,
                                 then.a_world_m_s2);
  };
  const Vec3 wanted_ahead = wanted_at(ahead);
  const Vec3 tilt_part(wanted_ahead.x(), wanted_ahead.y(), wanted_at(now).z());
  // a tilt that lags is carried round by the turning body
  const double carried_rad = now.yaw_rate_rad_s * attitude_lag_s(vehicle.autopilot);
  return {.p_world_m = now.p_world_m,
          .v_world_m_s = now.v_world_m_s,
          .a_world_m_s2 = Eigen::AngleAxisd(-carried_rad, Vec3::UnitZ()) * tilt_part,
          .yaw_rad = now.yaw_rad,
          .yaw_rate_rad_s = now.yaw_rate_rad_s};
}

/// Holds the setpoint for as long as it lasts; why the flight ends, if it does.
std::optional<LegEnd> hold(Flight& flight, const Setpoint& setpoint,
                           const std::function<bool(const Flight&)>& on_tick) {
  flight.command(setpoint);
  for (int i = 0; i < kTicksPerSetpoint; ++i) {
    flight.step();
    const bool goes_on = !on_tick || on_tick(flight);
    if (flight.has_collided()) return LegEnd::collision;
    if (!goes_on) return LegEnd::stopped;
  }
  return std::nullopt;
}

/// The reference of one leg: the straight line, and the short way round to the heading.
class Leg {
 public:
  Leg(const ViewPose& start, const ViewPose& goal, double speed_m_s, const GuidanceConfig& config,
      const VehicleConfig& vehicle)
      : start_(start),
        goal_(goal),
        turn_rad_(wrap_angle_rad(goal.yaw_rad - start.yaw_rad)),
        direction_((goal.p_world_m - start.p_world_m).normalized()),
        path_((goal.p_world_m - start.p_world_m).norm(),
              {speed_along(direction_, speed_m_s, vehicle), config.acceleration_m_s2,
               config.jerk_m_s3}),
        turn_(std::abs(turn_rad_), turn_limits(config, vehicle)) {}

  double duration_s() const { return std::max(path_.duration_s(), turn_.duration_s()); }

  Reference at(double time_s) const {
    const Motion path = path_.at(time_s);
    const Motion turn = turn_.at(time_s);
    Reference now{
        .p_world_m = start_.p_world_m + path.position * direction_,
        .v_world_m_s = path.speed * direction_,
        .a_world_m_s2 = path.acceleration * direction_,
        .yaw_rad = wrap_angle_rad(start_.yaw_rad + std::copysign(turn.position, turn_rad_)),
        .yaw_rate_rad_s = std::copysign(turn.speed, turn_rad_)};
    if (time_s >= path_.duration_s()) now.p_world_m = goal_.p_world_m;
    if (time_s >= turn_.duration_s()) now.yaw_rad = goal_.yaw_rad;
    return now;
  }

 private:
  ViewPose start_;
  ViewPose goal_;
  double turn_rad_;
  Vec3 direction_;
  RestToRest path_;
  RestToRest turn_;
};

ViewPose level_pose(const VehicleState& state) {
  return {state.T_world_body.translation(), yaw_of(state.T_world_body)};
}

bool has_arrived(const VehicleState& state, const ViewPose& goal, const GuidanceConfig& config) {
  const ViewPose pose = level_pose(state);
  return (pose.p_world_m - goal.p_world_m).norm() <= config.arrival_distance_m &&
         std::abs(wrap_angle_rad(pose.yaw_rad - goal.yaw_rad)) <= config.arrival_yaw_rad &&
         state.v_world_m_s.norm() <= config.arrival_speed_m_s;
}

}  // namespace

LegEnd fly_leg(Flight& flight, const ViewPose& goal, double speed_m_s, const GuidanceConfig& config,
               const VehicleConfig& vehicle, const std::function<bool(const Flight&)>& on_tick) {
  GNBV_CHECK(goal.p_world_m.allFinite() && std::isfinite(goal.yaw_rad) && speed_m_s > 0.0,
             "the goal must be finite and the speed, {} m/s, positive", speed_m_s);
  const Leg leg(level_pose(flight.estimate()), goal, speed_m_s, config, vehicle);
  if (!(leg.duration_s() <= kLongestLeg_s)) return LegEnd::timeout;
  const double lag_s = attitude_lag_s(vehicle.autopilot);
  for (int sent = 0;; ++sent) {
    const double time_s = sent * kTicksPerSetpoint * kTick_s;
    if (time_s > leg.duration_s() + config.timeout_s) return LegEnd::timeout;
    const Setpoint setpoint = setpoint_of(leg.at(time_s), leg.at(time_s + lag_s), vehicle);
    if (const auto over = hold(flight, setpoint, on_tick)) return *over;
    if (time_s >= leg.duration_s() && has_arrived(flight.estimate(), goal, config)) {
      return LegEnd::arrived;
    }
  }
}

LegEnd fly_path(Flight& flight, std::span<const Reference> path, std::size_t& at, std::size_t poses,
                const VehicleConfig& vehicle, const std::function<bool(const Flight&)>& on_tick) {
  const auto lag =
      static_cast<std::size_t>(std::lround(attitude_lag_s(vehicle.autopilot) / kReference_s));
  while (at < path.size() && path[at].passed < poses) {
    const Reference& now = path[at];
    const Reference& ahead = path[std::min(at + lag, path.size() - 1)];
    ++at;
    if (const auto over = hold(flight, setpoint_of(now, ahead, vehicle), on_tick)) return *over;
  }
  return LegEnd::arrived;
}

double speed_along(const Vec3& direction, double speed_m_s, const VehicleConfig& vehicle) {
  if (vehicle.kind == VehicleKind::ideal) return speed_m_s;
  const AutopilotParameters& autopilot = vehicle.autopilot;
  const auto limited = [&](double speed, double share, double limit_m_s) {
    return share > 0.0 ? std::min(speed, kShareOfLimit * limit_m_s / share) : speed;
  };
  double speed = limited(speed_m_s, direction.head<2>().norm(), autopilot.speed_max_m_s);
  speed = limited(speed, direction.z(), autopilot.climb_speed_max_m_s);
  return limited(speed, -direction.z(), autopilot.descent_speed_max_m_s);
}

RestToRest::Limits turn_limits(const GuidanceConfig& config, const VehicleConfig& vehicle) {
  const double sharp_rad_s = config.image_motion_max_rad_s;
  const double rate_rad_s =
      sharp_rad_s > 0.0 ? std::min(config.yaw_rate_rad_s, sharp_rad_s) : config.yaw_rate_rad_s;
  if (vehicle.kind == VehicleKind::ideal) {
    return {rate_rad_s, config.yaw_acceleration_rad_s2, config.yaw_jerk_rad_s3};
  }
  const double authority_rad_s2 = 0.1 * yaw_authority_rad_s2(vehicle.airframe);
  const double share = std::min(1.0, authority_rad_s2 / config.yaw_acceleration_rad_s2);
  return {std::min(rate_rad_s, kShareOfLimit * vehicle.autopilot.rate_max_rad_s.z()),
          share * config.yaw_acceleration_rad_s2, share * config.yaw_jerk_rad_s3};
}

Vec3 place_on_leg_m(const ViewPose& from, const ViewPose& goal, double time_s, double speed_m_s,
                    const GuidanceConfig& config, const VehicleConfig& vehicle) {
  return Leg(from, goal, speed_m_s, config, vehicle).at(time_s).p_world_m;
}

double leg_duration_s(const ViewPose& from, const ViewPose& goal, double speed_m_s,
                      const GuidanceConfig& config, const VehicleConfig& vehicle) {
  return Leg(from, goal, speed_m_s, config, vehicle).duration_s();
}

double leg_energy_wh(const VehicleConfig& vehicle, const GuidanceConfig& guidance,
                     const ViewPose& from, const ViewPose& to) {
  const double duration_s = leg_duration_s(from, to, guidance.path_speed_m_s, guidance, vehicle);
  if (duration_s <= 0.0) return 0.0;
  double drawn_w = hover_power_w(vehicle);
  if (vehicle.kind == VehicleKind::quadrotor) {  // the ideal one draws hover power all the way
    const double weight_n = vehicle.airframe.mass_kg * vehicle.airframe.gravity_m_s2;
    const Vec3 v_mean_m_s = (to.p_world_m - from.p_world_m) / duration_s;
    drawn_w = std::max(drawn_w, power_w(vehicle.power, weight_n, v_mean_m_s));
  }
  return drawn_w * (duration_s + kArrival_s) / kJoulesPerWattHour;
}

double landing_energy_wh(const VehicleConfig& vehicle, double height_m) {
  const CommanderParameters& commander = vehicle.autopilot.commander;
  const double duration_s = std::max(0.0, height_m) / commander.land_speed_m_s +
                            commander.land_detection_s +
                            std::max(0.0, commander.disarm_after_landing_s);
  return hover_power_w(vehicle) * duration_s / kJoulesPerWattHour;
}

Vec3 acceleration_setpoint(const AirframeParameters& airframe, const AutopilotParameters& autopilot,
                           const Vec3& v_world_m_s, const Vec3& a_world_m_s2) {
  const auto rotors = static_cast<double>(airframe.rotors.size());
  Vec3 body_z_world = Vec3::UnitZ();
  double speed_rad_s = hover_speed_rad_s(airframe);
  // thrust and tilt depend on the drag, and the drag on both, but weakly: eight turns leave less
  // than 1 mm/s^2, even with the strongest drag of the presets
  for (int i = 0; i < 8; ++i) {
    const Eigen::Quaterniond q = turn_between(Vec3::UnitZ(), body_z_world);
    const Vec3 v_body_m_s = q.conjugate() * v_world_m_s;
    const Vec3 v_disk_m_s(v_body_m_s.x(), v_body_m_s.y(), 0.0);
    const double drag_per_s =
        rotors * speed_rad_s * airframe.drag_coefficient_n_s2_per_m / airframe.mass_kg;
    const Vec3 thrust_m_s2 =
        a_world_m_s2 + airframe.gravity_m_s2 * Vec3::UnitZ() + drag_per_s * (q * v_disk_m_s);
    body_z_world = thrust_m_s2.normalized();
    const double thrust_at_rest_n =
        airframe.mass_kg * thrust_m_s2.norm() / thrust_share(airframe, v_body_m_s);
    speed_rad_s = std::sqrt(thrust_at_rest_n / (rotors * airframe.thrust_coefficient_n_s2));
  }
  // position_control tilts by a_xy over g, and takes the command's vertical part for 1 + a_z / g
  // of the hover command
  const double lift =
      command_at_speed(airframe, speed_rad_s) * body_z_world.z() / hover_command(airframe);
  const Vec3 setpoint =
      airframe.gravity_m_s2 *
      Vec3(body_z_world.x() / body_z_world.z(), body_z_world.y() / body_z_world.z(), lift - 1.0);
  return setpoint + autopilot.velocity_d.cwiseProduct(a_world_m_s2);
}

HoverTrim hover_trim(const VehicleConfig& vehicle, const Vec3& wind_world_m_s) {
  const double gravity_m_s2 = vehicle.airframe.gravity_m_s2;
  const Vec3 a_world_m_s2 =
      acceleration_setpoint(vehicle.airframe, vehicle.autopilot, -wind_world_m_s, Vec3::Zero());
  const double tilt_rad = std::atan2(a_world_m_s2.head<2>().norm(), gravity_m_s2);
  return {a_world_m_s2, tilt_rad,
          hover_command(vehicle.airframe) * (1.0 + a_world_m_s2.z() / gravity_m_s2) /
              std::cos(tilt_rad)};
}

}  // namespace gnbv
