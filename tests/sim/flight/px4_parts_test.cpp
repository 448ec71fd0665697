// Laws of the pieces that Px4 is made of: trajectories, takeoff ramp, land detector.
#include <gtest/gtest.h>

#include "sim/core/rng.hpp"
#include "sim/flight/commander.hpp"
#include "sim/flight/trajectory.hpp"
#include "sim/flight/vehicle.hpp"
#include "sim/mesh/world.hpp"

namespace gnbv {
namespace {

constexpr AxisLimits kLimits;  // PX4's 3 m/s^2 and 4 m/s^3

double uniform(std::uint64_t draw, double min, double max) {
  return min + (max - min) * uniform01({7, Stream::bench, 0, draw});
}

TEST(VelocitySmoothing, BrakingSpeedIsPx4s) {  // the sheet's values, four digits
  EXPECT_NEAR(braking_speed(1.0, kLimits), 0.6235, 5e-5);
  EXPECT_NEAR(braking_speed(5.0, kLimits), 2.589, 5e-4);
  EXPECT_NEAR(braking_speed(10.0, kLimits), 4.458, 5e-4);
  EXPECT_EQ(braking_speed(0.0, kLimits), 0.0);
}

TEST(VelocitySmoothing, EveryChangeEndsAtItsSpeedWithinItsLimits) {
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const Motion start{0.0, uniform(3 * i, -5, 5), uniform(3 * i + 1, -3, 3)};
    const double wanted_m_s = uniform(3 * i + 2, -5, 5);
    const SpeedChange change = speed_change(start, wanted_m_s, kLimits);
    const Motion end = advance(start, change, change.duration_s());
    ASSERT_NEAR(end.speed, wanted_m_s, 1e-12);
    ASSERT_EQ(end.acceleration, 0.0);
    for (int k = 1; k < 20; ++k) {
      const double share = 0.05 * k;
      ASSERT_LE(std::abs(advance(start, change, share * change.duration_s()).acceleration),
                3.0 + 1e-12);
    }
  }
}

TEST(VelocitySmoothing, FromRestItTakesTheClosedFormsTime) {
  for (const double dv : {0.5, 2.0, -2.0, 5.0, -12.0}) {
    // below a^2 / j the limit is not reached: 2 sqrt(dv / j); above: dv / a + a / j
    const double size = std::abs(dv);
    const double time_s = size < 9.0 / 4.0 ? 2.0 * std::sqrt(size / 4.0) : size / 3.0 + 3.0 / 4.0;
    EXPECT_NEAR(speed_change({}, dv, kLimits).duration_s(), time_s, 1e-12) << dv;
    for (const double longer : {1.0, 1.5, 4.0}) {
      const SpeedChange slow = speed_change({}, dv, kLimits, longer * time_s);
      EXPECT_NEAR(slow.duration_s(), longer * time_s, 1e-9);
      EXPECT_NEAR(advance({}, slow, slow.duration_s()).speed, dv, 1e-12);
    }
  }
}

TEST(VelocitySmoothing, StepsOfADifferentLengthGoTheSameWay) {
  const Motion start{1.0, -2.0, 0.5};
  const SpeedChange change = speed_change(start, 3.0, kLimits);
  const Motion once = advance(start, change, change.duration_s());
  Motion replanned = start;  // as the Auto modes do
  for (int i = 0; i < 1000; ++i) {
    replanned =
        advance(replanned, speed_change(replanned, 3.0, kLimits), change.duration_s() / 1000);
  }
  EXPECT_NEAR(replanned.position, once.position, 1e-6);  // a thousand roundings
  EXPECT_NEAR(replanned.speed, once.speed, 1e-6);
}

TEST(VelocitySmoothing, ShorterAxesWaitForTheLongest) {
  std::array<Motion, 3> axes{};
  for (int i = 0; i < 50; ++i) {
    axes = advance_together(axes, {4.0, 2.0, 0.0}, {kLimits, kLimits, kLimits}, 0.02);
    EXPECT_EQ(axes[2].position, 0.0);
  }
  // same time, half the change: the accelerations keep near that ratio, not both at the limit
  EXPECT_LT(axes[1].acceleration, 0.7 * axes[0].acceleration);
  const double before_s = speed_change(axes[0], 4.0, kLimits).duration_s();
  for (int i = 0; 0.02 * i < before_s + 0.02; ++i) {
    axes = advance_together(axes, {4.0, 2.0, 0.0}, {kLimits, kLimits, kLimits}, 0.02);
  }
  EXPECT_NEAR(axes[0].speed, 4.0, 1e-9);
  EXPECT_NEAR(axes[1].speed, 2.0, 1e-9);
}

TEST(VelocitySmoothing, BrakingSpeedArrivesWithoutPassingTheGoal) {
  for (const double goal_m : {1.0, 5.0, 30.0}) {
    Motion axis;
    for (int i = 0; i < 1500; ++i) {
      const double way_m = goal_m - axis.position;
      const double wanted = std::min(5.0, braking_speed(std::max(0.0, way_m), kLimits));
      axis = advance(axis, speed_change(axis, wanted, kLimits), 0.02);
      ASSERT_LT(axis.position, goal_m + 0.01);
      ASSERT_LE(axis.speed, 5.0 + 1e-9);
      ASSERT_LE(std::abs(axis.acceleration), 3.0 + 1e-9);
    }
    EXPECT_NEAR(axis.position, goal_m, 0.01) << goal_m;
  }
}

TEST(RateSteps, SeeTheBodyRateGrowEvenlyUnderConstantTorque) {
  AirframeParameters airframe;
  airframe.drag_coefficient_n_s2_per_m = 0.0;
  airframe.rolling_coefficient_n_s2 = 0.0;
  World world;
  world.has_ground = false;
  const RotorSpeeds speeds = {800, 800, 810, 810};  // yaw only
  const double alpha_rad_s2 =
      rotor_wrench(airframe, speeds, Vec3::Zero(), Vec3::Zero()).torque_body_n_m.z() /
      airframe.inertia_kg_m2.z();
  RigidVehicle vehicle(airframe, world, VehicleState{}, speeds);
  int calls = 0;
  for (int tick = 0; tick < 50; ++tick) {
    vehicle.step([&](const Vec3& omega_body_rad_s) {
      // the unequal arms let it roll and pitch a little, which turns it at second order
      EXPECT_NEAR(omega_body_rad_s.z(), calls * kRateStep_s * alpha_rad_s2, 1e-9);
      ++calls;
      return speeds;
    });
  }
  EXPECT_EQ(calls, 50 * kRateStepsPerTick);
}

TEST(Takeoff, ClimbLimitIsLinearOverTheRamp) {  // 19
  const CommanderParameters commander;
  const double dt_s = 0.02;
  Takeoff takeoff;
  int spool = 0;
  while (takeoff.phase < TakeoffPhase::ramp) {
    takeoff = next(takeoff, commander, true, true, true, dt_s);
    EXPECT_NEAR(climb_limit_m_s(takeoff, 9.8066, 4.0, 3.0), -9.8066 / 4.0, 1e-12);
    ASSERT_LT(++spool, 1000);
  }
  EXPECT_NEAR(spool * dt_s, 1.0, dt_s + 1e-12);
  for (int i = 1; i < 150; ++i) {
    takeoff = next(takeoff, commander, true, false, true, dt_s);
    ASSERT_NEAR(climb_limit_m_s(takeoff, 9.8066, 4.0, 3.0),
                -9.8066 / 4.0 + i / 150.0 * (3.0 + 9.8066 / 4.0), 1e-12);
  }
  takeoff = next(takeoff, commander, true, false, true, dt_s);
  takeoff = next(takeoff, commander, true, false, true, dt_s);
  EXPECT_EQ(takeoff.phase, TakeoffPhase::flight);
  EXPECT_EQ(climb_limit_m_s(takeoff, 9.8066, 4.0, 3.0), 3.0);
}

TEST(Takeoff, WaitsUntilSomebodyWantsToFly) {
  const CommanderParameters commander;
  Takeoff takeoff;
  for (int i = 0; i < 500; ++i) takeoff = next(takeoff, commander, true, true, false, 0.02);
  EXPECT_EQ(takeoff.phase, TakeoffPhase::ready);
  EXPECT_EQ(next(takeoff, commander, true, true, true, 0.02).phase, TakeoffPhase::ramp);
  EXPECT_EQ(next(takeoff, commander, false, true, true, 0.02).phase, TakeoffPhase::disarmed);
}

constexpr LandEvidence kTouching{.is_armed = true,
                                 .is_told_to_descend = true,
                                 .thrust = 0.12,
                                 .thrust_min = 0.12,
                                 .hover_thrust = 0.7};

TEST(LandDetector, ThreeStagesTakeOneSecond) {
  LandDetector detector;
  int steps = 0;
  while (!detector.is_landed && steps < 1000) {
    detector = next(detector, {}, kTouching, VehicleState{}, kTick_s);
    ++steps;
    EXPECT_FALSE(steps * kTick_s < 0.33 && detector.has_ground_contact);
    EXPECT_FALSE(steps * kTick_s < 0.66 && detector.is_maybe_landed);
  }
  EXPECT_NEAR(steps * kTick_s, 1.0, 3.5 * kTick_s);  // each stage is counted in whole ticks
}

TEST(LandDetector, AnyMotionOrThrustIsNoLanding) {
  const auto lands = [&](const LandEvidence& evidence, const Vec3& v_m_s = Vec3::Zero(),
                         double roll_deg_s = 0.0) {
    VehicleState state;
    state.v_world_m_s = v_m_s;
    state.omega_body_rad_s.x() = deg_to_rad(roll_deg_s);
    LandDetector detector;
    for (int i = 0; i < 1000; ++i) detector = next(detector, {}, evidence, state, kTick_s);
    return detector.is_landed;
  };
  EXPECT_TRUE(lands(kTouching));
  EXPECT_FALSE(lands(kTouching, Vec3(0, 0, -0.3)));
  EXPECT_FALSE(lands(kTouching, Vec3(1.6, 0, 0)));
  EXPECT_TRUE(lands(kTouching, Vec3(0.5, 0, 0.1)));
  EXPECT_FALSE(lands(kTouching, Vec3::Zero(), 21.0));
  LandEvidence hovering = kTouching, staying = kTouching;
  hovering.thrust = 0.7;
  staying.is_told_to_descend = false;
  EXPECT_FALSE(lands(hovering));
  EXPECT_FALSE(lands(staying));
  staying.is_armed = false;
  EXPECT_TRUE(lands(staying, Vec3(0.5, 0, 0.1)));
}

}  // namespace
}  // namespace gnbv
