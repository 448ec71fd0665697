#include "sim/guidance.hpp"

#include <algorithm>
#include <cmath>

#include "sim/core/error.hpp"
#include "sim/rest_to_rest.hpp"

namespace gnbv {
namespace {

constexpr int kTicksPerSetpoint = 5;  // 20 ms

/// The reference of one leg: the straight line, and the short way round to the heading.
class Leg {
 public:
  Leg(const ViewPose& start, const ViewPose& goal, double speed_m_s, const GuidanceConfig& config)
      : start_(start),
        goal_(goal),
        turn_rad_(wrap_angle_rad(goal.yaw_rad - start.yaw_rad)),
        direction_(direction(start, goal)),
        path_((goal.p_world_m - start.p_world_m).norm(), speed_along(direction_, speed_m_s, config),
              config.acceleration_m_s2, config.smoothing_s),
        turn_(std::abs(turn_rad_), config.yaw_rate_rad_s, config.yaw_acceleration_rad_s2,
              config.smoothing_s) {}

  double duration_s() const { return std::max(path_.duration_s(), turn_.duration_s()); }

  Setpoint at(double time_s, const GuidanceConfig& config) const {
    const RestToRest::Sample path = path_.at(time_s);
    const RestToRest::Sample turn = turn_.at(time_s);
    Setpoint setpoint;
    setpoint.p_world_m = start_.p_world_m + path.position * direction_;
    setpoint.v_world_m_s = path.speed * direction_;
    setpoint.yaw_rad = wrap_angle_rad(start_.yaw_rad + std::copysign(turn.position, turn_rad_));
    setpoint.yaw_rate_rad_s = std::copysign(turn.speed, turn_rad_);
    setpoint.a_world_m_s2 =
        acceleration_ahead(config.feed_forward, time_s, setpoint.yaw_rate_rad_s);
    if (time_s >= path_.duration_s()) setpoint.p_world_m = goal_.p_world_m;
    if (time_s >= turn_.duration_s()) setpoint.yaw_rad = goal_.yaw_rad;
    return setpoint;
  }

 private:
  static Vec3 direction(const ViewPose& start, const ViewPose& goal) {
    const Vec3 line_m = goal.p_world_m - start.p_world_m;
    const double length_m = line_m.norm();
    return length_m > 0.0 ? Vec3(line_m / length_m) : Vec3(Vec3::Zero());
  }

  static double speed_along(const Vec3& direction, double speed_m_s, const GuidanceConfig& config) {
    const double rise = direction.z();
    if (rise > 0.0) return std::min(speed_m_s, config.climb_speed_max_m_s / rise);
    if (rise < 0.0) return std::min(speed_m_s, config.descent_speed_max_m_s / -rise);
    return speed_m_s;
  }

  /// The acceleration setpoint that lets the cascade follow without building up an error.
  Vec3 acceleration_ahead(const FeedForward& ff, double time_s, double yaw_rate_rad_s) const {
    const RestToRest::Sample ahead = path_.at(time_s + ff.attitude_lag_s);
    const Vec3 a_m_s2 = ahead.acceleration * direction_;
    const Vec3 v_m_s = ahead.speed * direction_;
    const Vec3 wanted(ff.gain_xy * a_m_s2.x() + ff.drag_xy_per_s * v_m_s.x(),
                      ff.gain_xy * a_m_s2.y() + ff.drag_xy_per_s * v_m_s.y(),
                      ff.gain_z * a_m_s2.z() + ff.drag_z_per_s * std::abs(v_m_s.z()));
    // a tilt that lags is carried round by the turning body
    return Eigen::AngleAxisd(-yaw_rate_rad_s * ff.attitude_lag_s, Vec3::UnitZ()) * wanted;
  }

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
               const std::function<bool(const Flight&)>& on_tick) {
  GNBV_CHECK(goal.p_world_m.allFinite() && std::isfinite(goal.yaw_rad) && speed_m_s > 0.0,
             "the goal must be finite and the speed, {} m/s, positive", speed_m_s);
  const Leg leg(level_pose(flight.estimate()), goal, speed_m_s, config);
  for (int sent = 0;; ++sent) {
    const double time_s = sent * kTicksPerSetpoint * kTick_s;
    if (time_s > leg.duration_s() + config.timeout_s) return LegEnd::timeout;
    flight.command(leg.at(time_s, config));
    for (int i = 0; i < kTicksPerSetpoint; ++i) {
      flight.step();
      const bool goes_on = !on_tick || on_tick(flight);
      if (flight.has_collided()) return LegEnd::collision;
      if (!goes_on) return LegEnd::stopped;
    }
    if (time_s >= leg.duration_s() && has_arrived(flight.estimate(), goal, config)) {
      return LegEnd::arrived;
    }
  }
}

}  // namespace gnbv
