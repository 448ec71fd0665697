// Laws of the offboard interface. The numbers are those of the sheet's list of tests
// (facts/vehicle.md, section 3); 10 to 14 belong to the MAVLink border.
#include <gtest/gtest.h>

#include <cstring>

#include "tests/sim/flight/bare_vehicle.hpp"
#include "tests/sim/flight/px4_client.hpp"

namespace gnbv {
namespace {

/// Until it hovers in HOLD, and the stream is long silent.
void hold(Quadrotor& quadrotor) {
  ASSERT_EQ(quadrotor.px4().set_mode(NavState::hold), Ack::accepted);
  wait(quadrotor, 2.0);
}

TEST(Offboard, IsRefusedInFlightWithoutAStreamAndTakenWhileStreaming) {  // 1, 2
  Quadrotor quadrotor = airborne();
  hold(quadrotor);
  EXPECT_EQ(quadrotor.px4().set_mode(NavState::offboard), Ack::temporarily_rejected);
  EXPECT_EQ(quadrotor.px4().nav_state(), NavState::hold);
  EXPECT_EQ(quadrotor.px4().intention(), NavState::hold);
  stream(quadrotor, go_to(Vec3(0, 0, 10)), 0.5);
  EXPECT_EQ(quadrotor.px4().set_mode(NavState::offboard), Ack::accepted);
  EXPECT_EQ(quadrotor.px4().nav_state(), NavState::offboard);
}

TEST(Offboard, ASlowStreamDropsWithAShortTimeoutAndHoldsWithALongOne) {  // 3
  constexpr int kPeriod = 132;                                           // ticks: 1.9 Hz
  for (const auto& [loss_s, holds] : {std::pair(0.5, false), std::pair(1.0, true)}) {
    Quadrotor quadrotor = airborne(with({.offboard_loss_s = loss_s}));
    bool has_dropped = false;
    for (int i = 0; i < ticks(10.0); ++i) {
      if (i % kPeriod == 0) quadrotor.command(go_to(Vec3(0, 0, 10)));
      quadrotor.step();
      has_dropped = has_dropped || quadrotor.px4().is_in_failsafe();
    }
    EXPECT_EQ(has_dropped, !holds) << loss_s;
  }
}

TEST(Offboard, FailsafeComesWhenTheTimeoutIsOver) {  // 4
  for (const double loss_s : {0.5, 1.0}) {
    Quadrotor quadrotor = airborne(with({.offboard_loss_s = loss_s}));
    stream(quadrotor, go_to(Vec3(0, 0, 10)), 1.0, 1);
    const int silent =
        ticks_until(quadrotor, 3.0, [&] { return quadrotor.px4().is_in_failsafe(); });
    EXPECT_NEAR(silent, ticks(loss_s), 1);  // one cycle
    EXPECT_EQ(quadrotor.px4().nav_state(), NavState::hold);
    EXPECT_EQ(quadrotor.px4().intention(), NavState::offboard);
    EXPECT_TRUE(has_said(quadrotor.px4(), "Failsafe"));
  }
}

TEST(Offboard, ComesBackWhenTheStreamDoes) {  // 5
  Quadrotor quadrotor = airborne();
  wait(quadrotor, 3.0);
  ASSERT_TRUE(quadrotor.px4().is_in_failsafe());
  stream(quadrotor, go_to(Vec3(2, 0, 10)), 0.1);
  EXPECT_EQ(quadrotor.px4().nav_state(), NavState::offboard);
  EXPECT_FALSE(quadrotor.px4().is_in_failsafe());
  stream(quadrotor, go_to(Vec3(2, 0, 10)), 8.0);
  EXPECT_NEAR(place(quadrotor).x(), 2.0, 0.05);
}

TEST(Offboard, SetpointsWithoutANumberOrWithXAndNoYAreHeldWithAWarning) {  // 6, 7
  Quadrotor quadrotor = airborne();
  stream(quadrotor, fly_at(Vec3(2, 0, 0)), 4.0);
  quadrotor.px4().take_messages();
  stream(quadrotor, Setpoint{}, 0.9);
  EXPECT_EQ(quadrotor.px4().nav_state(), NavState::offboard);  // not yet lost
  EXPECT_LT(quadrotor.state().v_world_m_s.norm(), 1.0);        // but braking
  EXPECT_TRUE(has_said(quadrotor.px4(), "Invalid"));
  stream(quadrotor, Setpoint{}, 0.5);
  EXPECT_FALSE(has_said(quadrotor.px4(), "Invalid"));      // said once
  EXPECT_EQ(quadrotor.px4().nav_state(), NavState::hold);  // it is no heartbeat
  stream(quadrotor, Setpoint{}, 8.0);
  EXPECT_LT(quadrotor.state().v_world_m_s.norm(), 0.01);
  Quadrotor other = airborne();
  stream(other, go_to(Vec3(5, kNan, 10)), 4.0);
  EXPECT_TRUE(has_said(other.px4(), "Invalid"));
  EXPECT_LT(std::abs(place(other).x()), 0.01);  // stayed
}

TEST(Offboard, AnInvalidSetpointStartsNoTakeoff) {
  Quadrotor quadrotor = on_ground();
  const Setpoint below = go_to(Vec3(1, 2, -1));
  stream(quadrotor, below, 0.1);
  ASSERT_EQ(quadrotor.px4().set_mode(NavState::offboard), Ack::accepted);
  ASSERT_EQ(quadrotor.px4().arm(true), Ack::accepted);
  stream(quadrotor, below, 2.0);  // the rotors have spun up, and wait
  for (int i = 0; i < ticks(0.9); ++i) {
    stream(quadrotor, go_to(Vec3(1, kNan, 5)), kTick_s);
    ASSERT_EQ(quadrotor.px4().attitude_setpoint().thrust, 0.0);
  }
  stream(quadrotor, go_to(Vec3(1, 2, 5)), 0.1);
  EXPECT_GT(quadrotor.px4().attitude_setpoint().thrust, 0.0);
}

TEST(Offboard, FliesNoSetpointThatCameInAnotherMode) {
  Quadrotor quadrotor = airborne();
  hold(quadrotor);
  stream(quadrotor, go_to(Vec3(5, 0, 10)), 0.5);
  ASSERT_EQ(quadrotor.px4().set_mode(NavState::offboard), Ack::accepted);
  wait(quadrotor, 0.9);
  EXPECT_EQ(quadrotor.px4().nav_state(), NavState::offboard);
  EXPECT_LT((place(quadrotor) - Vec3(0, 0, 10)).norm(), 0.01);  // stops and holds until the first
  stream(quadrotor, go_to(Vec3(5, 0, 10)), 8.0);
  EXPECT_NEAR(place(quadrotor).x(), 5.0, 0.05);
}

TEST(Offboard, VelocityBesideAPositionIsFedForward) {  // 8
  // a target that moves: with its velocity the vehicle follows without the lag v / P of 1.05 m
  const auto lag_m = [](double share) {
    Quadrotor quadrotor = airborne();
    Setpoint setpoint = go_to(Vec3(0, 0, 10));
    for (int i = 0; i < ticks(15.0); ++i) {
      setpoint.p_world_m.x() = i * kTick_s;
      if (share > 0.0) setpoint.v_world_m_s = Vec3(share, 0, 0);
      quadrotor.command(setpoint);
      quadrotor.step();
    }
    return setpoint.p_world_m.x() - place(quadrotor).x();
  };
  EXPECT_NEAR(lag_m(0.0), 1.0 / 0.95, 0.05);  // integrators: the loop is settled to some per cent
  EXPECT_NEAR(lag_m(1.0), 0.0, 0.05);
}

TEST(Offboard, NanYawKeepsTheHeadingDuringAStep) {  // 9
  Quadrotor quadrotor = airborne({}, {Vec3(0, 0, 10), 0.7});
  for (int i = 0; i < ticks(10.0); ++i) {
    stream(quadrotor, go_to(Vec3(5, 0, 10), kNan), kTick_s);
    // PX4 then follows the heading there is, so a hard tilt drags it along: measured 2.9 deg
    ASSERT_NEAR(yaw_of(quadrotor.state().T_world_body), 0.7, deg_to_rad(3.5));
  }
  EXPECT_NEAR(place(quadrotor).x(), 5.0, 0.05);
}

TEST(Offboard, DisarmingInTheAirNeedsForce) {  // 15
  Quadrotor quadrotor = airborne();
  EXPECT_EQ(quadrotor.px4().command({400, {0, 0}}), Ack::temporarily_rejected);
  EXPECT_TRUE(quadrotor.px4().is_armed());
  EXPECT_EQ(quadrotor.px4().command({400, {0, 21196}}), Ack::accepted);
  EXPECT_FALSE(quadrotor.px4().is_armed());
  wait(quadrotor, 0.5);
  EXPECT_EQ(quadrotor.px4().step(quadrotor.estimate()), RotorSpeeds{});
  EXPECT_LT(quadrotor.state().v_world_m_s.z(), -3.0);  // falls
}

TEST(Offboard, LiftsOffNoSoonerThanTheRotorsHaveSpunUp) {  // 19
  Quadrotor quadrotor = on_ground();
  const Setpoint above = go_to(Vec3(1, 2, 5), 0.5);
  stream(quadrotor, above, 0.5);
  ASSERT_EQ(quadrotor.px4().set_mode(NavState::offboard), Ack::accepted);
  ASSERT_EQ(quadrotor.px4().arm(true), Ack::accepted);
  const double stand_m = place(quadrotor).z();
  for (int i = 0; i < ticks(1.0 + 3.0); ++i) {
    stream(quadrotor, above, kTick_s);
    if (i < ticks(1.0)) {
      ASSERT_NEAR(place(quadrotor).z(), stand_m, 5e-4);  // Bullet lets it sink and rise a little
    }
    // the limit on the ramp, from -g / P to 3 m/s; a vertical overshoot of some cm/s
    const double share = (i * kTick_s - 1.0) / 3.0;
    const double limit_m_s = -9.8066 / 4.0 + share * (3.0 + 9.8066 / 4.0);
    ASSERT_LE(quadrotor.state().v_world_m_s.z(), std::max(0.0, limit_m_s) + 0.1);
  }
  EXPECT_GT(place(quadrotor).z(), stand_m + 0.2);
}

TEST(Offboard, LongStepsKeepToSpeedAndTiltLimits) {  // 20
  Quadrotor quadrotor = airborne();
  double speed_m_s = 0.0;
  double tilt = 0.0;
  for (int i = 0; i < ticks(12.0); ++i) {
    stream(quadrotor, go_to(Vec3(30, 0, 10)), kTick_s);
    speed_m_s = std::max(speed_m_s, quadrotor.state().v_world_m_s.norm());
    tilt = std::max(tilt, tilt_rad(quadrotor.px4().attitude_setpoint().q_world_body));
  }
  EXPECT_LE(speed_m_s, 12.0);
  EXPECT_GT(speed_m_s, 8.0);
  EXPECT_NEAR(tilt, deg_to_rad(45.0), 1e-6);  // reached, never passed: rounding of acos
}

TEST(Offboard, VerticalSpeedSetpointKeepsItsLimits) {  // 21
  // whatever is asked, the thrust is that of the limit itself
  const VehicleConfig config;
  const auto thrust = [&](const Setpoint& setpoint) {
    PositionControlMemory memory;
    return position_control(config.autopilot, config.airframe, memory, VehicleState{}, setpoint)
        .thrust;
  };
  for (const double far_m : {4.0, 40.0, 400.0}) {
    for (const double ahead_m_s : {0.0, 5.0}) {
      Setpoint up = go_to(Vec3(0, 0, far_m));
      up.v_world_m_s = Vec3(0, 0, ahead_m_s);
      EXPECT_DOUBLE_EQ(thrust(up), thrust(fly_at(Vec3(0, 0, 3.0))));
      Setpoint down = go_to(Vec3(0, 0, -far_m));
      down.v_world_m_s = Vec3(0, 0, -ahead_m_s);
      EXPECT_DOUBLE_EQ(thrust(down), thrust(fly_at(Vec3(0, 0, -1.5))));
    }
  }
  EXPECT_GT(thrust(fly_at(Vec3(0, 0, -1.4))), thrust(fly_at(Vec3(0, 0, -1.5))));
}

/// Everything at once: takeoff, steps, a lost stream, a way home and a landing.
std::pair<VehicleState, double> long_flight() {
  Quadrotor quadrotor = on_ground();
  stream(quadrotor, go_to(Vec3(1, 2, 4), 1.0), 0.1);
  quadrotor.px4().set_mode(NavState::offboard);
  quadrotor.px4().arm(true);
  stream(quadrotor, go_to(Vec3(1, 2, 4), 1.0), 8.0);
  stream(quadrotor, go_to(Vec3(4, -2, 3), -2.0), 5.0);
  wait(quadrotor, 3.0);
  quadrotor.px4().set_mode(NavState::rtl);
  wait(quadrotor, 30.0);
  EXPECT_FALSE(quadrotor.px4().is_armed());
  return {quadrotor.state(), quadrotor.energy_wh()};
}

TEST(Offboard, ReplaysBitByBitAfterAnyOtherFlight) {  // 23
  const auto [one, energy_one] = long_flight();
  Quadrotor other = airborne();
  stream(other, fly_at(Vec3(1, 2, 0.5)), 3.0);
  const auto [two, energy_two] = long_flight();
  EXPECT_EQ(std::memcmp(one.T_world_body.data(), two.T_world_body.data(), 16 * sizeof(double)), 0);
  EXPECT_EQ(one.v_world_m_s, two.v_world_m_s);
  EXPECT_EQ(one.omega_body_rad_s, two.omega_body_rad_s);
  EXPECT_EQ(energy_one, energy_two);
}

}  // namespace
}  // namespace gnbv
