// Laws of the waypoint follower and its reference.
#include "sim/guidance.hpp"

#include <gtest/gtest.h>

#include "sim/core/error.hpp"
#include "sim/rest_to_rest.hpp"

namespace gnbv {
namespace {

const GuidanceConfig kGuidance;
const ViewPose kStart = {Vec3(0, 0, 10), 0.0};

VehicleConfig kind(VehicleKind vehicle) {
  VehicleConfig config;
  config.kind = vehicle;
  return config;
}

/// How a leg from kStart went.
struct Report {
  LegEnd end = LegEnd::timeout;
  double time_s = 0.0;
  double off_line_m = 0.0;   // farthest from the straight line
  double past_goal_m = 0.0;  // also in the 3 s after arrival
  double drift_m = 0.0;      // farthest from the goal in those 3 s
  VehicleState state;        // at arrival
};

Report fly(VehicleKind vehicle, const ViewPose& goal, double speed_m_s) {
  const auto flight = make_flight(kind(vehicle), World{}, kStart);
  const Vec3 line_m = goal.p_world_m - kStart.p_world_m;
  const Vec3 direction = line_m.norm() > 0.0 ? Vec3(line_m.normalized()) : Vec3(1, 0, 0);
  Report report;
  const auto watch = [&](const Flight& now) {
    const Vec3 p_m = now.state().T_world_body.translation() - kStart.p_world_m;
    const double along_m = p_m.dot(direction);
    report.off_line_m = std::max(report.off_line_m, (p_m - along_m * direction).norm());
    report.past_goal_m = std::max(report.past_goal_m, along_m - line_m.norm());
  };
  report.end = fly_leg(*flight, goal, speed_m_s, kGuidance, watch);
  report.time_s = static_cast<double>(flight->tick()) * kTick_s;
  report.state = flight->state();
  for (int i = 0; i < 3 * kTicksPerSecond; ++i) {
    flight->step();
    watch(*flight);
    report.drift_m = std::max(report.drift_m,
                              (flight->state().T_world_body.translation() - goal.p_world_m).norm());
  }
  return report;
}

/// Hops, long legs, climbs, descents, turns on the spot and on the way.
std::vector<std::pair<ViewPose, double>> legs() {
  std::vector<std::pair<ViewPose, double>> all;
  const auto add = [&](double x, double y, double z, double yaw_deg, double speed_m_s) {
    all.push_back({{kStart.p_world_m + Vec3(x, y, z), deg_to_rad(yaw_deg)}, speed_m_s});
  };
  add(1, 0, 0, 0, 2);
  add(0, -1, 0, 90, 2);
  add(0.2, 0, 0, -30, 2);
  add(20, 0, 0, 0, 2);
  add(12, -9, -2, 30, 1);
  add(0, 0, 5, 0, 2);
  add(0, 0, -5, 0, 2);
  add(5, 5, 5, 120, 2);
  add(5, 5, -5, -170, 2);
  add(0, 0, 0, 180, 2);
  add(0, 0, 0, 0, 2);
  return all;
}

TEST(Guidance, QuadrotorArrivesAndStaysOnTheLine) {
  for (const auto& [goal, speed_m_s] : legs()) {
    const Report report = fly(VehicleKind::quadrotor, goal, speed_m_s);
    const std::string name = fmt::format("to {} {} {} yaw {}", goal.p_world_m.x(),
                                         goal.p_world_m.y(), goal.p_world_m.z(), goal.yaw_rad);
    EXPECT_EQ(report.end, LegEnd::arrived) << name;
    EXPECT_LT(report.off_line_m, 0.03) << name;   // measured 2.2 cm at worst
    EXPECT_LT(report.past_goal_m, 0.03) << name;  // measured 1.9 cm at worst
    EXPECT_LT(report.drift_m, 0.03) << name;      // no hunting
    EXPECT_LT((report.state.T_world_body.translation() - goal.p_world_m).norm(), 0.1) << name;
    EXPECT_LT(report.state.v_world_m_s.norm(), 0.05) << name;
    EXPECT_LT(std::abs(wrap_angle_rad(yaw_of(report.state.T_world_body) - goal.yaw_rad)),
              deg_to_rad(3.0))
        << name;
  }
}

TEST(Guidance, AHopTakesThreeSecondsAndTwentyMetresFourteen) {
  const Report hop = fly(VehicleKind::quadrotor, {Vec3(1, 0, 10), 0.0}, 2.0);
  EXPECT_GT(hop.time_s, 3.0);
  EXPECT_LT(hop.time_s, 4.5);
  const Report leg = fly(VehicleKind::quadrotor, {Vec3(20, 0, 10), 0.0}, 2.0);
  EXPECT_GT(leg.time_s, 13.0);
  EXPECT_LT(leg.time_s, 15.0);
}

TEST(Guidance, IdealVehicleFliesExactlyTheLine) {
  for (const auto& [goal, speed_m_s] : legs()) {
    const Report report = fly(VehicleKind::ideal, goal, speed_m_s);
    EXPECT_EQ(report.end, LegEnd::arrived);
    EXPECT_LT(report.off_line_m, 1e-12);  // rounding at 20 m
    EXPECT_LT(report.past_goal_m, 1e-12);
    EXPECT_EQ(report.state.T_world_body.matrix(), T_world_body(goal).matrix());
    EXPECT_EQ(report.state.v_world_m_s, Vec3(0, 0, 0));
  }
}

TEST(Guidance, TurnsTheShortWay) {
  const ViewPose start = {Vec3(0, 0, 10), deg_to_rad(170.0)};
  const auto flight = make_flight(kind(VehicleKind::ideal), World{}, start);
  double turned_rad = 0.0;
  double before_rad = start.yaw_rad;
  const auto watch = [&](const Flight& now) {
    const double yaw_rad = yaw_of(now.state().T_world_body);
    turned_rad += wrap_angle_rad(yaw_rad - before_rad);
    EXPECT_LE(std::abs(wrap_angle_rad(yaw_rad - before_rad)), kGuidance.yaw_rate_rad_s * 0.02001);
    before_rad = yaw_rad;
  };
  fly_leg(*flight, {start.p_world_m, deg_to_rad(-150.0)}, 2.0, kGuidance, watch);
  EXPECT_NEAR(turned_rad, deg_to_rad(40.0), 1e-9);
}

TEST(Guidance, DescendsNoFasterThanAllowed) {
  const auto flight = make_flight(kind(VehicleKind::ideal), World{}, {Vec3(0, 0, 30), 0.0});
  double fastest_m_s = 0.0;
  const auto watch = [&](const Flight& now) {
    fastest_m_s = std::max(fastest_m_s, -now.state().v_world_m_s.z());
  };
  fly_leg(*flight, {Vec3(5, 0, 10), 0.0}, 2.0, kGuidance, watch);
  EXPECT_NEAR(fastest_m_s, kGuidance.descent_speed_max_m_s, 1e-9);
}

TEST(Guidance, ContactEndsTheLeg) {
  const auto flight = make_flight({}, World{}, {Vec3(0, 0, 1), 0.0});
  EXPECT_EQ(fly_leg(*flight, {Vec3(0, 0, -1), 0.0}, 1.0, kGuidance, nullptr), LegEnd::collision);
}

TEST(Guidance, NeverArrivingEndsInATimeout) {
  GuidanceConfig strict;
  strict.arrival_distance_m = -1.0;
  strict.timeout_s = 5.0;
  const auto flight = make_flight(kind(VehicleKind::ideal), World{}, kStart);
  EXPECT_EQ(fly_leg(*flight, {Vec3(1, 0, 10), 0.0}, 2.0, strict, nullptr), LegEnd::timeout);
  const double leg_s =
      RestToRest(1.0, 2.0, strict.acceleration_m_s2, strict.smoothing_s).duration_s();
  EXPECT_NEAR(static_cast<double>(flight->tick()) * kTick_s, leg_s + 5.0, 0.041);  // 2 setpoints
}

TEST(Guidance, NanGoalThrowsBrokenInvariant) {
  const auto flight = make_flight({}, World{}, kStart);
  EXPECT_THROW(fly_leg(*flight, {Vec3::Constant(std::nan("")), 0.0}, 2.0, kGuidance, nullptr),
               BrokenInvariant);
}

/// Passes on to the ideal vehicle and notes when it was commanded.
class Recorder final : public Flight {
 public:
  std::int64_t tick() const override { return flight_->tick(); }
  VehicleState state() const override { return flight_->state(); }
  void command(const Setpoint& setpoint) override {
    commanded_ticks.push_back(tick());
    flight_->command(setpoint);
  }
  void step() override { flight_->step(); }
  bool has_collided() const override { return flight_->has_collided(); }
  double energy_wh() const override { return flight_->energy_wh(); }
  std::vector<std::int64_t> commanded_ticks;

 private:
  std::unique_ptr<Flight> flight_ = make_flight(kind(VehicleKind::ideal), World{}, kStart);
};

TEST(Guidance, StreamsASetpointEvery20ms) {
  Recorder recorder;
  std::int64_t watched = 0;
  fly_leg(recorder, {Vec3(3, 0, 10), 1.0}, 2.0, kGuidance, [&](const Flight&) { ++watched; });
  ASSERT_GT(recorder.commanded_ticks.size(), 100U);
  for (std::size_t i = 0; i < recorder.commanded_ticks.size(); ++i) {
    EXPECT_EQ(recorder.commanded_ticks[i], static_cast<std::int64_t>(5 * i));
  }
  EXPECT_EQ(watched, recorder.tick());  // on_tick after every tick
}

TEST(RestToRest, EndsExactlyAtTheDistanceAtRest) {
  for (const double distance : {0.0, 1e-9, 0.3, 1.0, 5.0, 123.4}) {
    const RestToRest motion(distance, 2.0, 0.6, 0.5);
    const RestToRest::Sample end = motion.at(motion.duration_s());
    EXPECT_EQ(end.position, distance);
    EXPECT_EQ(end.speed, 0.0);
    EXPECT_NEAR(motion.at(motion.duration_s() - 1e-9).position, distance, 1e-12);
    EXPECT_EQ(motion.at(0.0).position, 0.0);
  }
}

TEST(RestToRest, TakesTheTrapezoidsTimePlusTheSmoothing) {
  EXPECT_NEAR(RestToRest(20.0, 2.0, 0.5, 0.4).duration_s(), 20.0 / 2.0 + 2.0 / 0.5 + 0.4, 1e-12);
  EXPECT_NEAR(RestToRest(1.0, 2.0, 0.5, 0.4).duration_s(), 2.0 * std::sqrt(1.0 / 0.5) + 0.4, 1e-12);
}

TEST(RestToRest, ObeysItsLimitsAndItsDerivativesAgree) {
  for (const double distance : {0.05, 1.0, 20.0}) {
    const RestToRest motion(distance, 2.0, 0.6, 0.5);
    const double h = 1e-4;
    for (double t = h; t < motion.duration_s() - h; t += 0.01) {
      const auto [position, speed, acceleration] = motion.at(t);
      const auto before = motion.at(t - h);
      const auto after = motion.at(t + h);
      EXPECT_LE(speed, 2.0 + 1e-12);
      EXPECT_LE(std::abs(acceleration), 0.6 + 1e-12);
      EXPECT_LE(std::abs(after.acceleration - before.acceleration),
                2.0 * h * 2.0 * 0.6 / 0.5 + 1e-9);  // jerk, twice as much across the peak
      EXPECT_GE(after.position, before.position - 1e-12);
      // central differences: h^2 times the jerk, and rounding / h
      EXPECT_NEAR((after.position - before.position) / (2.0 * h), speed, 1e-7);
      EXPECT_NEAR((after.speed - before.speed) / (2.0 * h), acceleration, 2e-4);
    }
  }
}

TEST(RestToRest, IsSymmetricInTime) {
  const RestToRest motion(7.0, 2.0, 0.6, 0.5);
  for (double t = 0.0; t < motion.duration_s(); t += 0.1) {
    EXPECT_NEAR(motion.at(t).position + motion.at(motion.duration_s() - t).position, 7.0, 1e-9);
  }
}

}  // namespace
}  // namespace gnbv
