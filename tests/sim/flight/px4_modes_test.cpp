// Laws of arming, modes and failsafe beyond the offboard stream itself.
#include <gtest/gtest.h>

#include "tests/sim/flight/px4_client.hpp"

namespace gnbv {
namespace {

TEST(Px4Modes, TakesOffHoversLandsAndDisarms) {
  Quadrotor low = on_ground();
  ASSERT_EQ(low.px4().command({22, {0, 0, 0, 0, 0, 0, static_cast<float>(kNan)}}), Ack::accepted);
  ASSERT_EQ(low.px4().arm(true), Ack::accepted);
  wait(low, 20.0);
  EXPECT_NEAR(place(low).z(), 2.5, 0.05) << "the default";

  Quadrotor quadrotor = on_ground();
  Px4& px4 = quadrotor.px4();
  ASSERT_EQ(px4.command({22, {0, 0, 0, 0, 0, 0, 4.0F}}), Ack::accepted);
  ASSERT_EQ(px4.command({400, {1}}), Ack::accepted);
  EXPECT_TRUE(px4.is_landed());
  double tilt = 0.0;
  double climb_m_s = 0.0;
  const int taken_off = ticks_until(quadrotor, 30.0, [&] {
    tilt = std::max(tilt, tilt_rad(Eigen::Quaterniond(quadrotor.state().T_world_body.linear())));
    climb_m_s = std::max(climb_m_s, quadrotor.state().v_world_m_s.z());
    return px4.nav_state() == NavState::hold;
  });
  ASSERT_GT(taken_off, 0);
  EXPECT_FALSE(px4.is_landed());
  EXPECT_LT(tilt, deg_to_rad(0.5));  // nothing tips it over
  EXPECT_LE(climb_m_s, 1.5 + 0.1);   // MPC_TKO_SPEED, and some overshoot
  wait(quadrotor, 5.0);
  EXPECT_NEAR(place(quadrotor).z(), 4.0, 0.05);
  EXPECT_NEAR((place(quadrotor) - Vec3(1, 2, 4)).head<2>().norm(), 0.0, 0.01);

  ASSERT_EQ(px4.command({21, {}}), Ack::accepted);
  EXPECT_EQ(px4.nav_state(), NavState::land);
  EXPECT_GT(ticks_until(quadrotor, 20.0, [&] { return !px4.is_armed(); }), 0);
  EXPECT_NEAR(place(quadrotor).z(), 0.5 * AirframeParameters{}.hull_height_m, 0.005);
  EXPECT_NEAR((place(quadrotor) - Vec3(1, 2, 0)).head<2>().norm(), 0.0, 0.02);
  EXPECT_EQ(px4.nav_state(), NavState::hold);  // LAND would prevent arming
  EXPECT_FALSE(quadrotor.has_collided());      // it was told to touch the ground
  wait(quadrotor, kTick_s);
  EXPECT_EQ(quadrotor.power_w(), 0.0);
}

TEST(Px4Modes, StandsStillOnTheGroundForAsLongAsItLikesInAnyWind) {
  Quadrotor quadrotor = on_ground({}, {Vec3(10, 0, 0), 0.0});
  const Isometry T0 = quadrotor.state().T_world_body;
  for (int i = 0; i < 60; ++i) {
    wait(quadrotor, 1.0);
    ASSERT_LT((place(quadrotor) - T0.translation()).norm(), 1e-3);
    ASSERT_LT(quadrotor.state().v_world_m_s.norm(), 2e-3);
    ASSERT_LT((quadrotor.state().T_world_body.linear() - T0.linear()).norm(), 2e-3);
  }
  EXPECT_TRUE(quadrotor.px4().is_landed());
  EXPECT_FALSE(quadrotor.has_collided());
  EXPECT_EQ(quadrotor.energy_wh(), 0.0);
}

TEST(Px4Modes, HoveringJustAboveTheGroundIsNoLanding) {
  Quadrotor quadrotor = airborne({}, {Vec3(0, 0, 0.15), 0.0});
  stream(quadrotor, go_to(Vec3(0, 0, 0.15)), 20.0);
  EXPECT_TRUE(quadrotor.px4().is_armed());
  EXPECT_FALSE(quadrotor.px4().is_landed());
  EXPECT_FALSE(quadrotor.has_collided());
}

TEST(Px4Modes, DisarmsSoLongAfterLandingOrArmingAndNeverAtZero) {  // commander_params.c; 17, 18
  for (const double landed_s : {2.0, kTick_s, 0.0, -1.0}) {
    Quadrotor quadrotor =
        airborne(with({.disarm_after_landing_s = landed_s}), {Vec3(0, 0, 2), 0.0});
    stream(quadrotor, go_to(Vec3(0, 0, 2)), 2.0);
    EXPECT_TRUE(quadrotor.px4().is_armed());
    quadrotor.land();
    ASSERT_GT(ticks_until(quadrotor, 60.0, [&] { return quadrotor.px4().is_landed(); }), 0);
    EXPECT_LT(place(quadrotor).z(), 0.06);  // on its hull
    const int waited = ticks_until(quadrotor, 20.0, [&] { return !quadrotor.px4().is_armed(); });
    EXPECT_NEAR(waited, landed_s > 0.0 ? ticks(landed_s) : -1, landed_s > 0.0 ? 1 : 0) << landed_s;
  }
  for (const double idle_s : {10.0, 0.0}) {
    Quadrotor quadrotor = on_ground(with({.disarm_never_flown_s = idle_s}));
    wait(quadrotor, 1.0);
    ASSERT_EQ(quadrotor.px4().arm(true), Ack::accepted);
    const int waited = ticks_until(quadrotor, 20.0, [&] { return !quadrotor.px4().is_armed(); });
    EXPECT_NEAR(waited, idle_s > 0.0 ? ticks(idle_s) : -1, idle_s > 0.0 ? 1 : 0) << idle_s;
  }
}

TEST(Px4Modes, OffboardDescentLandsAndAnotherSetpointTakesOffAgain) {
  Quadrotor quadrotor = airborne({}, {Vec3(0, 0, 1), 0.0});
  for (int i = 0; i < 1000 && !quadrotor.px4().is_landed(); ++i) {
    stream(quadrotor, fly_at(Vec3(0, 0, -0.5)), 5 * kTick_s);
  }
  ASSERT_TRUE(quadrotor.px4().is_landed());
  stream(quadrotor, go_to(Vec3(0, 0, 2)), 12.0);
  EXPECT_TRUE(quadrotor.px4().is_armed());
  EXPECT_NEAR(place(quadrotor).z(), 2.0, 0.05);
}

TEST(Px4Modes, HoldBrakesAndStays) {
  Quadrotor quadrotor = airborne();
  stream(quadrotor, fly_at(Vec3(4, 3, 0)), 6.0);
  ASSERT_NEAR(quadrotor.state().v_world_m_s.norm(), 5.0, 0.2);
  ASSERT_EQ(quadrotor.px4().set_mode(NavState::hold), Ack::accepted);
  const Vec3 from = place(quadrotor);
  wait(quadrotor, 25.0);  // the integrators had learnt the drag, and forget it in 4.5 s (P / I)
  const Vec3 stopped = place(quadrotor);
  EXPECT_LT(quadrotor.state().v_world_m_s.norm(), 0.01);
  // both axes brake in the time of the faster, v / a + a / j, along a curve of mean speed v / 2
  const double brake_m = 2.5 * (4.0 / 3.0 + 3.0 / 4.0);
  EXPECT_NEAR((stopped - from).norm(), brake_m, 0.05 * brake_m);  // it was flown at 5 m/s +- 4 %
  wait(quadrotor, 10.0);
  EXPECT_LT((place(quadrotor) - stopped).norm(), 0.02);
}

TEST(Px4Modes, ReturnClimbsFliesHomeAndLands) {
  Quadrotor quadrotor = airborne(with({.return_altitude_m = 15.0}), {Vec3(0, 0, 5), 0.0});
  stream(quadrotor, go_to(Vec3(20, -10, 5)), 12.0);
  ASSERT_EQ(quadrotor.px4().command({20, {}}), Ack::accepted);
  double top_m = 0.0;
  double speed_m_s = 0.0;
  const int returned = ticks_until(quadrotor, 120.0, [&] {
    top_m = std::max(top_m, place(quadrotor).z());
    speed_m_s = std::max(speed_m_s, quadrotor.state().v_world_m_s.head<2>().norm());
    return !quadrotor.px4().is_armed();
  });
  EXPECT_GT(returned, 0);
  EXPECT_NEAR(top_m, 15.0, 0.2);
  EXPECT_LE(speed_m_s, 5.0 * 1.1);  // MPC_XY_CRUISE, and the loop's overshoot
  EXPECT_LT(place(quadrotor).head<2>().norm(), 0.2);
  EXPECT_EQ(quadrotor.px4().intention(), NavState::offboard);  // RTL would prevent arming
}

TEST(Px4Modes, AutoModesArriveHoweverFarAndFast) {
  for (const double cruise_m_s : {5.0, 20.0}) {  // the latter above MPC_XY_VEL_MAX
    Quadrotor quadrotor = airborne(with({.cruise_speed_m_s = cruise_m_s}));
    const Vec3 goal(200, 0, 10);
    ASSERT_EQ(quadrotor.px4().reposition(goal, 0.0, 0.0), Ack::accepted);
    wait(quadrotor, 60.0);
    EXPECT_LT((place(quadrotor) - goal).norm(), 0.1) << cruise_m_s;
  }
  Quadrotor quadrotor = airborne();
  stream(quadrotor, fly_at(Vec3(12, 0, 0)), 10.0);
  ASSERT_EQ(quadrotor.px4().set_mode(NavState::land), Ack::accepted);
  EXPECT_GT(ticks_until(quadrotor, 60.0, [&] { return !quadrotor.px4().is_armed(); }), 0);
}

TEST(Px4Modes, TerminationStopsTheMotorsForGood) {
  Quadrotor quadrotor = airborne();
  ASSERT_EQ(quadrotor.px4().set_mode(NavState::terminate), Ack::accepted);
  EXPECT_EQ(quadrotor.px4().step(quadrotor.estimate()), RotorSpeeds{});
  for (const NavState mode : {NavState::hold, NavState::offboard, NavState::land}) {
    EXPECT_EQ(quadrotor.px4().set_mode(mode), Ack::temporarily_rejected);
  }
  wait(quadrotor, 8.0);  // falls, and lies there
  EXPECT_FALSE(quadrotor.px4().is_armed());
  EXPECT_EQ(quadrotor.px4().arm(true), Ack::temporarily_rejected);
  EXPECT_TRUE(quadrotor.has_collided());  // a flight that began in the air
}

TEST(Px4Modes, EveryLossActionDoesWhatItSays) {
  using enum OffboardLoss;
  for (const auto& [action, mode] :
       {std::pair(position, NavState::hold), std::pair(altitude, NavState::hold),
        std::pair(stabilized, NavState::hold), std::pair(rtl, NavState::rtl),
        std::pair(land, NavState::land), std::pair(hold, NavState::hold),
        std::pair(terminate, NavState::terminate), std::pair(disarm, NavState::offboard)}) {
    Quadrotor quadrotor = airborne(with({.offboard_loss_action = action}));
    Px4& px4 = quadrotor.px4();
    wait(quadrotor, 1.1);
    if (action == disarm) {
      EXPECT_FALSE(px4.is_armed());
      continue;
    }
    EXPECT_EQ(px4.nav_state(), mode);
    EXPECT_TRUE(px4.is_in_failsafe());
    if (action != hold && action != land) continue;
    px4.take_messages();  // the same mode by command ends the failsafe
    EXPECT_EQ(px4.set_mode(mode), Ack::accepted);
    EXPECT_FALSE(px4.is_in_failsafe());
    EXPECT_TRUE(has_said(px4, "Failsafe over"));
    wait(quadrotor, 0.5);
    EXPECT_EQ(px4.set_mode(NavState::rtl), Ack::accepted);
    EXPECT_FALSE(has_said(px4, "Failsafe"));  // it was over before
  }
}

TEST(Px4Modes, ALossCanBeHeldBeforeItIsActedOn) {  // PX4 1.9: two stages
  Quadrotor quadrotor = airborne(with({.offboard_loss_s = 0.5,
                                       .offboard_loss_hold_s = 5.0,
                                       .offboard_loss_action = OffboardLoss::rtl}));
  const auto runs = [&](NavState mode) {
    return ticks_until(quadrotor, 10.0, [&] { return quadrotor.px4().nav_state() == mode; });
  };
  EXPECT_NEAR(runs(NavState::hold), ticks(0.5), 1);
  EXPECT_NEAR(runs(NavState::rtl), ticks(5.0), 1);
  stream(quadrotor, go_to(Vec3(0, 0, 10)), 0.1);
  EXPECT_EQ(quadrotor.px4().nav_state(), NavState::offboard);
}

TEST(Px4Modes, ModesThatCannotRunFallBackToHold) {
  CommanderParameters commander;
  const auto choice = [&](NavState intention, double silence_s) {
    return choose_mode(intention, silence_s, commander).value();
  };
  for (const NavState mode : {NavState::manual, NavState::stabilized, NavState::altitude,
                              NavState::position, NavState::mission}) {
    EXPECT_EQ(choice(mode, 0.0), NavState::hold) << name_of(mode);
  }
  for (const NavState mode :
       {NavState::hold, NavState::rtl, NavState::takeoff, NavState::land, NavState::terminate}) {
    EXPECT_EQ(choice(mode, 100.0), mode) << name_of(mode);
  }
  EXPECT_EQ(choice(NavState::offboard, 0.0), NavState::offboard);
}

TEST(Px4Modes, AcknowledgementsAreMavResults) {
  Quadrotor quadrotor = on_ground();
  Px4& px4 = quadrotor.px4();
  const auto mode = [&](float main_mode, float sub_mode) {
    return px4.command({176, {1, main_mode, sub_mode}});
  };
  // disarmed, any mode is taken, and arming then fails where it cannot run
  EXPECT_EQ(mode(6, 0), Ack::accepted);
  EXPECT_EQ(px4.nav_state(), NavState::offboard);
  EXPECT_EQ(px4.arm(true), Ack::temporarily_rejected);
  EXPECT_EQ(px4.arm(true, true), Ack::temporarily_rejected);  // checks are never skipped
  for (const auto& [main_mode, state] :
       {std::pair(1.0F, NavState::manual), std::pair(2.0F, NavState::altitude),
        std::pair(3.0F, NavState::position), std::pair(7.0F, NavState::stabilized)}) {
    EXPECT_EQ(mode(main_mode, 0), Ack::accepted);
    EXPECT_EQ(px4.intention(), state);
    EXPECT_EQ(px4.arm(true), Ack::temporarily_rejected);
  }
  for (const auto& [sub_mode, state] :
       {std::pair(2.0F, NavState::takeoff), std::pair(3.0F, NavState::hold),
        std::pair(4.0F, NavState::mission), std::pair(5.0F, NavState::rtl),
        std::pair(6.0F, NavState::land)}) {
    EXPECT_EQ(mode(4, sub_mode), Ack::accepted);
    EXPECT_EQ(px4.intention(), state);
    EXPECT_TRUE(!prevents_arming(state) || px4.arm(true) == Ack::temporarily_rejected);  // 16
  }
  EXPECT_EQ(mode(4, 3), Ack::accepted);
  EXPECT_EQ(mode(9, 0), Ack::temporarily_rejected);
  EXPECT_EQ(mode(4, 9), Ack::temporarily_rejected);
  EXPECT_EQ(px4.intention(), NavState::hold);
  EXPECT_EQ(px4.command({400, {2}}), Ack::unsupported);
  EXPECT_EQ(px4.command({400, {static_cast<float>(kNan)}}), Ack::unsupported);
  EXPECT_EQ(px4.command({511, {}}), Ack::unsupported);
  EXPECT_EQ(px4.arm(true), Ack::accepted);
  // armed, only what can run, and LAND in any case
  EXPECT_EQ(mode(3, 0), Ack::temporarily_rejected);
  EXPECT_EQ(mode(4, 4), Ack::temporarily_rejected);  // no mission here
  EXPECT_EQ(mode(4, 6), Ack::accepted);
}

TEST(Px4Modes, DuplicatesAreAcceptedAndChangeNothing) {
  Quadrotor quadrotor = on_ground();
  Px4& px4 = quadrotor.px4();
  EXPECT_EQ(px4.arm(false), Ack::accepted);
  EXPECT_EQ(px4.arm(true), Ack::accepted);
  wait(quadrotor, 6.0);
  EXPECT_EQ(px4.arm(true), Ack::accepted);  // the idle time goes on
  EXPECT_NEAR(ticks_until(quadrotor, 12.0, [&] { return !px4.is_armed(); }), ticks(4.0), 1);
  Quadrotor flying = airborne();
  stream(flying, go_to(Vec3(0, 0, 10)), 1.0);
  EXPECT_EQ(flying.px4().set_mode(NavState::offboard), Ack::accepted);
  EXPECT_EQ(flying.px4().set_mode(NavState::offboard), Ack::accepted);
  EXPECT_EQ(flying.px4().nav_state(), NavState::offboard);
  flying.px4().set_mode(NavState::land);
  wait(flying, 2.0);
  const double v_m_s = flying.state().v_world_m_s.z();
  EXPECT_EQ(flying.px4().set_mode(NavState::land), Ack::accepted);
  wait(flying, 0.2);
  EXPECT_NEAR(flying.state().v_world_m_s.z(), v_m_s, 0.2);
}

TEST(Px4Modes, HoldStaysWhereItBeganAndArmingOnTheGroundIsHomeOfTheReturn) {
  Quadrotor quadrotor = on_ground();
  stream(quadrotor, go_to(Vec3(1, 2, 3), 0.5), 0.1);
  ASSERT_EQ(quadrotor.px4().set_mode(NavState::offboard), Ack::accepted);
  ASSERT_EQ(quadrotor.px4().arm(true), Ack::accepted);
  stream(quadrotor, go_to(Vec3(1, 2, 3), 0.5), 8.0);
  stream(quadrotor, go_to(Vec3(7, 2, 3), 0.5), 8.0);
  ASSERT_EQ(quadrotor.px4().set_mode(NavState::hold), Ack::accepted);
  wait(quadrotor, 10.0);
  EXPECT_LT((place(quadrotor) - Vec3(7, 2, 3)).norm(), 0.3);
  ASSERT_EQ(quadrotor.px4().set_mode(NavState::rtl), Ack::accepted);
  double top_m = 0.0;
  ASSERT_GT(ticks_until(quadrotor, 60.0,
                        [&] {
                          top_m = std::max(top_m, place(quadrotor).z());
                          return !quadrotor.px4().is_armed();
                        }),
            0);
  EXPECT_LT((place(quadrotor) - Vec3(1, 2, 0)).head<2>().norm(), 0.2);
  EXPECT_LT(top_m, 6.1);  // 6 m from home, in the cone; 0.8 m below it counts as reached
  EXPECT_GT(top_m, 5.1);
}

TEST(Px4Modes, FliesByTheEstimateNotByTheTruth) {
  VehicleConfig config;
  config.estimate.model = EstimateModel::gnss;
  const Vec3 goal(3, 1, 10);
  Quadrotor quadrotor = airborne(config);
  stream(quadrotor, go_to(goal), 20.0);
  const Vec3 believed = quadrotor.estimate().T_world_body.translation();
  EXPECT_LT((believed - goal).norm(), 0.05);  // the estimate wanders by some cm/s
  EXPECT_GT((place(quadrotor) - goal).norm(), 0.1);
}

}  // namespace
}  // namespace gnbv
