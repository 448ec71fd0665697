// Laws of the time-optimal reference.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sim/core/error.hpp"
#include "sim/flight/trajectory.hpp"

namespace gnbv {
namespace {

const RestToRest::Limits kPx4 = {5.0, 3.0, 4.0};  // MPC_XY_CRUISE, MPC_ACC_HOR, MPC_JERK_AUTO

struct Motion {
  double distance;
  RestToRest::Limits limits;
};

/// All shapes: with and without cruise, with and without constant acceleration.
std::vector<Motion> motions() {
  return {{0.05, {2.0, 1.0, 4.0}},
          {0.3, {2.0, 1.0, 4.0}},
          {1.0, {2.0, 1.0, 4.0}},
          {20.0, {2.0, 1.0, 4.0}},
          {5.0, {0.2, 1.0, 4.0}},
          {0.02, {0.2, 1.0, 4.0}},
          {1e-6, kPx4},
          {3.375, kPx4},
          {50.0, kPx4}};
}

TEST(RestToRest, TakesTheClosedFormsTime) {
  // sheet, section 4: two without cruise (the second just reaches the acceleration limit), one with
  // constant acceleration, one that cruises
  EXPECT_NEAR(RestToRest(1.0, kPx4).duration_s(), 2.000, 5e-4);
  EXPECT_NEAR(RestToRest(3.375, kPx4).duration_s(), 3.000, 5e-4);
  EXPECT_NEAR(RestToRest(10.0, kPx4).duration_s(), 4.478, 5e-4);
  EXPECT_NEAR(RestToRest(20.0, kPx4).duration_s(), 6.417, 5e-4);
  EXPECT_NEAR(RestToRest(2.5, kPx4).duration_s(), 4.0 * std::cbrt(2.5 / 8.0), 1e-12);
  // too slow to reach the acceleration limit: D / v + 2 sqrt(v / j)
  EXPECT_NEAR(RestToRest(5.0, {0.2, 1.0, 4.0}).duration_s(), 25.0 + 2.0 * std::sqrt(0.05), 1e-12);
}

TEST(RestToRest, EndsExactlyAtTheDistanceAtRest) {
  for (const auto& [distance, limits] : motions()) {
    const RestToRest motion(distance, limits);
    for (const double time_s : {motion.duration_s(), motion.duration_s() + 1.0}) {
      EXPECT_EQ(motion.at(time_s).position, distance);
      EXPECT_EQ(motion.at(time_s).speed, 0.0);
      EXPECT_EQ(motion.at(time_s).acceleration, 0.0);
    }
    EXPECT_EQ(motion.at(0.0).position, 0.0);
    EXPECT_EQ(motion.at(0.0).speed, 0.0);
  }
  EXPECT_EQ(RestToRest(0.0, kPx4).duration_s(), 0.0);
}

TEST(RestToRest, ObeysEveryLimitIsAtOneAtEveryMomentAndIntegratesItself) {
  for (const auto& [distance, limits] : motions()) {
    const RestToRest motion(distance, limits);
    constexpr int kSteps = 20000;
    const double h_s = motion.duration_s() / kSteps;
    const double h2_jerk = limits.jerk * h_s * h_s;
    double speed = 0.0, position = 0.0;
    int idle = 0;
    for (int i = 0; i < kSteps; ++i) {
      const auto a = motion.at(i * h_s);
      const auto b = motion.at((i + 1) * h_s);
      const double jerk = (b.acceleration - a.acceleration) / h_s;
      constexpr double kRounding = 1e-9;
      EXPECT_LE(b.speed, limits.speed + kRounding);
      EXPECT_LE(std::abs(b.acceleration), limits.acceleration + kRounding);
      EXPECT_LE(std::abs(jerk) * h_s, limits.jerk * h_s + kRounding);  // no jump either
      EXPECT_GE(b.position, a.position - kRounding);
      // time-optimal (bang-bang): jerk, acceleration or speed is at its limit
      idle += std::abs(jerk) > 0.999 * limits.jerk ||
                      std::abs(a.acceleration) > 0.999 * limits.acceleration ||
                      a.speed > 0.999 * limits.speed
                  ? 0
                  : 1;
      // the trapezoidal rule errs by at most T h^2 / 12 times the jerk, and cuts six corners by at
      // most j h^2 each
      speed += 0.5 * h_s * (a.acceleration + b.acceleration);
      position += 0.5 * h_s * (a.speed + b.speed);
      EXPECT_NEAR(speed, b.speed, 6.0 * h2_jerk + 1e-12);
      EXPECT_NEAR(position, b.position, motion.duration_s() * h2_jerk + 1e-12);
    }
    EXPECT_NEAR(position, distance, 1e-6 * distance);
    EXPECT_LE(idle, 6);  // the steps across a change of jerk
  }
}

TEST(RestToRest, WantsPositiveLimits) {
  EXPECT_THROW(RestToRest(-1.0, kPx4), BrokenInvariant);
  EXPECT_THROW(RestToRest(1.0, {1.0, 1.0, 0.0}), BrokenInvariant);
}

}  // namespace
}  // namespace gnbv
