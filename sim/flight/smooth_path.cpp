#include "sim/flight/smooth_path.hpp"

#include <algorithm>
#include <cmath>

#include "sim/core/rest_to_rest.hpp"
#include "sim/flight/guidance.hpp"
#include "sim/flight/trajectory.hpp"

namespace gnbv {
namespace {

// Braking is planned with this share of the acceleration: the rest corrects.
constexpr double kBrakingShare = 0.9;
constexpr double kCornerShare = 1.0;
constexpr double kPassShare = 0.95;
// Velocity follows what is wanted of it with these time constants, where the limits allow.
constexpr double kVelocity_s = 0.25;
constexpr double kTurn_s = 0.15;
// The last pose is approached with a speed of the distance over this.
constexpr double kApproach_s = 0.5;
constexpr double kAtRest_m = 0.03;
constexpr double kAtRest_m_s = 0.05;
constexpr double kTurned_rad = deg_to_rad(0.5);

/// The acceleration that leads to a change of velocity by `by`: proportional to it, within the
/// limit, and low enough that the jerk can take it back in time.
double acceleration_for(double by, double time_constant_s, double acceleration, double jerk) {
  return std::min({by / time_constant_s, acceleration, std::sqrt(2.0 * 0.7 * jerk * by)});
}

Vec3 shortened(const Vec3& v, double most) {
  const double length = v.norm();
  return length > most ? Vec3(v * (most / length)) : v;
}

class Way {
 public:
  Way(const Reference& from, std::span<const PassedPose> poses, double speed_m_s,
      const GuidanceConfig& config, const VehicleConfig& vehicle)
      : poses_(poses),
        speed_m_s_(speed_m_s),
        config_(config),
        vehicle_(vehicle),
        turn_(turn_limits(config, vehicle)),
        braking_{kBrakingShare * config.acceleration_m_s2, config.jerk_m_s3},
        now_(from) {
    now_.passed = 0;
    find_speeds();
  }

  const Reference& now() const { return now_; }
  bool is_over() const { return now_.passed == poses_.size(); }

  void step() {
    turns_off_ = may_turn_off();
    move_straight();
    turn();
    const bool is_last = now_.passed + 1 == poses_.size();
    if (is_last ? is_at_rest() : is_passed()) {
      ++now_.passed;
    }
  }

 private:
  const ViewPose& target() const { return poses_[now_.passed].pose; }
  double off_yaw_rad() const { return wrap_angle_rad(target().yaw_rad - now_.yaw_rad); }
  Vec3 to_m(std::size_t pose) const { return poses_[pose].pose.p_world_m - now_.p_world_m; }
  Vec3 to_target_m() const { return to_m(now_.passed); }

  bool is_passed() const {
    return to_target_m().norm() <= config_.pass_distance_m &&
           (!poses_[now_.passed].needs_yaw || std::abs(off_yaw_rad()) <= config_.pass_yaw_rad);
  }
  bool is_at_rest() const {
    return to_target_m().norm() <= kAtRest_m && now_.v_world_m_s.norm() <= kAtRest_m_s &&
           std::abs(off_yaw_rad()) <= kTurned_rad;
  }

  /// How long the heading still needs to be near enough to that of the pose.
  double turn_time_s(double from_rad, const PassedPose& to) const {
    if (!to.needs_yaw) return 0.0;
    const double off_rad = std::abs(wrap_angle_rad(to.pose.yaw_rad - from_rad));
    return rest_to_rest_s(std::max(0.0, off_rad - config_.pass_yaw_rad), turn_.speed,
                          turn_.acceleration);
  }

  /// How each pose may be passed, from the last one back.
  void find_speeds() {
    const double acceleration = kCornerShare * config_.acceleration_m_s2;
    corners_.assign(poses_.size(), {});
    out_.assign(poses_.size(), Vec3::Zero());
    for (std::size_t i = poses_.size() - 1; i-- > 0;) {
      const Vec3 before_m = i == 0 ? now_.p_world_m : poses_[i - 1].pose.p_world_m;
      const Vec3 in_m = poses_[i].pose.p_world_m - before_m;
      const Vec3 out_m = poses_[i + 1].pose.p_world_m - poses_[i].pose.p_world_m;
      const double way_m = out_m.norm();
      Corner& corner = corners_[i];
      corner.speed_m_s =
          std::min(speed_m_s_, braking_speed(way_m, braking_, corners_[i + 1].speed_m_s));
      const double turn_time = turn_time_s(poses_[i].pose.yaw_rad, poses_[i + 1]);
      if (turn_time > 0.0) {
        // braking evenly from twice the mean speed
        corner.speed_m_s =
            std::min(corner.speed_m_s, 2.0 * (way_m + config_.pass_distance_m) / turn_time);
      }
      if (way_m > 0.0) out_[i] = out_m / way_m;
      if (in_m.norm() == 0.0 || way_m == 0.0) continue;
      const double cosine = std::clamp(in_m.normalized().dot(out_m / way_m), -1.0, 1.0);
      const double sine = std::max(0.02, std::sqrt(0.5 * (1.0 - cosine)));  // of half the turn
      const double room_m =
          std::min({2.0 * config_.pass_distance_m / sine, 0.8 * in_m.norm(), 0.8 * way_m});
      corner.speed_m_s = std::min(corner.speed_m_s, std::sqrt(acceleration * room_m / sine));
      corner.begins_m = corner.speed_m_s * (corner.speed_m_s * sine / acceleration +
                                            0.5 * config_.acceleration_m_s2 / config_.jerk_m_s3);
    }
  }

  /// Whether the vehicle may turn off to the pose after the next one: with the acceleration that
  /// takes, it still comes near enough to the next, turned as it has to be.
  bool may_turn_off() const {
    if (now_.passed + 1 == poses_.size()) return false;
    const Vec3 to_m = to_target_m();
    const double turn_time = turn_time_s(now_.yaw_rad, poses_[now_.passed]);
    const Vec3& v = now_.v_world_m_s;
    const Vec3 change = v.norm() * out_[now_.passed] - v;
    const double acceleration = kCornerShare * config_.acceleration_m_s2;
    const double change_s = change.norm() / acceleration;
    if (change_s == 0.0) return false;
    const double lag_s = 0.5 * config_.acceleration_m_s2 / config_.jerk_m_s3;
    constexpr int kSamples = 8;
    for (int i = 0; i <= kSamples; ++i) {
      const double time_s = change_s * i / kSamples;
      if (lag_s + time_s < turn_time) continue;
      const Vec3 off_m = to_m - (lag_s + time_s) * v - 0.5 * time_s * time_s / change_s * change;
      if (off_m.norm() <= kPassShare * config_.pass_distance_m) return true;
    }
    return false;
  }

  Vec3 wanted_v_m_s() const {
    const std::size_t pose = now_.passed + (turns_off_ ? 1 : 0);
    const Vec3 ahead_m = to_m(pose);
    const double left_m = ahead_m.norm();
    if (left_m == 0.0) return Vec3::Zero();
    const Vec3 direction = ahead_m / left_m;
    const Corner& corner = corners_[pose];
    double speed_m_s = std::min(
        speed_along(direction, speed_m_s_, vehicle_),
        braking_speed(std::max(0.0, left_m - corner.begins_m), braking_, corner.speed_m_s));
    if (corner.speed_m_s == 0.0) speed_m_s = std::min(speed_m_s, left_m / kApproach_s);
    if (!turns_off_) {
      const double turn_time = turn_time_s(now_.yaw_rad, poses_[pose]);
      if (turn_time > 0.0) speed_m_s = std::min(speed_m_s, left_m / turn_time);
    }
    return speed_m_s * direction;
  }

  void move_straight() {
    const Vec3 change_m_s = wanted_v_m_s() - now_.v_world_m_s;
    const double by_m_s = change_m_s.norm();
    Vec3 wanted_m_s2 = Vec3::Zero();
    if (by_m_s > 0.0) {
      wanted_m_s2 =
          change_m_s / by_m_s *
          acceleration_for(by_m_s, kVelocity_s, config_.acceleration_m_s2, config_.jerk_m_s3);
    }
    const Vec3 a_before = now_.a_world_m_s2;
    now_.a_world_m_s2 += shortened(wanted_m_s2 - a_before, config_.jerk_m_s3 * kReference_s);
    const Vec3 v_before = now_.v_world_m_s;
    now_.v_world_m_s += 0.5 * kReference_s * (a_before + now_.a_world_m_s2);
    now_.p_world_m += 0.5 * kReference_s * (v_before + now_.v_world_m_s);
  }

  void turn() {
    const double off_rad = off_yaw_rad();
    const AxisLimits limits = {.acceleration = kBrakingShare * turn_.acceleration,
                               .jerk = turn_.jerk};
    const double wanted_rad_s =
        std::copysign(std::min({turn_.speed, braking_speed(std::abs(off_rad), limits),
                                std::abs(off_rad) / (2.0 * kTurn_s)}),
                      off_rad);
    const double change_rad_s = wanted_rad_s - now_.yaw_rate_rad_s;
    const double wanted_rad_s2 = std::copysign(
        acceleration_for(std::abs(change_rad_s), kTurn_s, turn_.acceleration, turn_.jerk),
        change_rad_s);
    const double most = turn_.jerk * kReference_s;
    const double before_rad_s = now_.yaw_rate_rad_s;
    now_.yaw_acceleration_rad_s2 +=
        std::clamp(wanted_rad_s2 - now_.yaw_acceleration_rad_s2, -most, most);
    now_.yaw_rate_rad_s += kReference_s * now_.yaw_acceleration_rad_s2;
    now_.yaw_rad =
        wrap_angle_rad(now_.yaw_rad + 0.5 * kReference_s * (before_rad_s + now_.yaw_rate_rad_s));
  }

  std::span<const PassedPose> poses_;
  double speed_m_s_;
  const GuidanceConfig& config_;
  const VehicleConfig& vehicle_;
  RestToRest::Limits turn_;
  AxisLimits braking_;
  struct Corner {
    double speed_m_s = 0.0;
    double begins_m = 0.0;  // before the pose
  };
  std::vector<Corner> corners_;  // at the poses
  std::vector<Vec3> out_;        // directions from each pose to the next
  bool turns_off_ = false;       // to the pose after the next
  Reference now_;
};

}  // namespace

std::vector<Reference> smooth_path(const Reference& from, std::span<const PassedPose> poses,
                                   double speed_m_s, const GuidanceConfig& config,
                                   const VehicleConfig& vehicle) {
  std::vector<Reference> references;
  Way way(from, poses, speed_m_s, config, vehicle);
  while (!way.is_over()) {
    if (static_cast<double>(references.size()) * kReference_s >= kLongestWay_s) return {};
    way.step();
    references.push_back(way.now());
  }
  return references;
}

}  // namespace gnbv
