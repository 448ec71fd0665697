// How `gnbv fly` follows the wall clock. No clock here: the times are given.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>

#include "sim/mavlink/serve.hpp"

namespace gnbv {
namespace {

constexpr std::array kSpeeds = {0.01, 0.5, 1.0, 4.0, 100.0};

double simulated_s(std::int64_t tick) { return static_cast<double>(tick) * kTick_s; }

/// A vehicle that is stepped as `serve` does, by a machine that takes no time for it.
struct Follower {
  explicit Follower(double speed) : pace(speed) {}
  /// One turn; how much it simulated.
  double turn(double now_s) {
    const std::int64_t before = tick;
    tick = std::max(tick, pace.turn_end(tick, now_s));
    has_given_up = pace.give_up_lag(tick, now_s);
    return simulated_s(tick - before);
  }
  Pace pace;
  std::int64_t tick = 0;
  bool has_given_up = false;
};

TEST(Pace, FollowsTheWallClockToTheTick) {
  for (const double speed : kSpeeds) {
    Follower vehicle(speed);
    for (int turn = 1; turn <= 2000; ++turn) {
      const double now_s = turn * kTurn_s;
      vehicle.turn(now_s);
      ASSERT_FALSE(vehicle.has_given_up) << speed;
      ASSERT_LE(std::abs(simulated_s(vehicle.tick) - speed * now_s), 1.001 * kTick_s) << speed;
    }
  }
}

TEST(Pace, ATickIsDueWhenItsTurnComes) {
  for (const double speed : kSpeeds) {
    const Pace pace(speed);
    for (std::int64_t tick = 0; tick < 1000; ++tick) {
      EXPECT_EQ(pace.turn_end(tick, pace.due_s(tick + 1) + 1e-9), tick + 1) << speed;
      EXPECT_EQ(pace.turn_end(tick, pace.due_s(tick + 1) - 1e-9), tick) << speed;
    }
  }
}

TEST(Pace, AStallIsMadeUpForByALittleAndInTurns) {
  for (const double speed : kSpeeds) {
    for (const double stall_s : {0.02, 0.1, 0.4, 10.0}) {
      Follower vehicle(speed);
      vehicle.turn(kTurn_s);
      const double now_s = kTurn_s + stall_s;
      const double turn_max_s = 2.0 * kTurn_s * speed + kTick_s;
      double burst_s = 0.0;
      for (int turn = 0; turn < 1000; ++turn) {
        const double step_s = vehicle.turn(now_s);
        EXPECT_LE(step_s, turn_max_s) << "heard again too late at speed " << speed;
        burst_s += step_s;
      }
      EXPECT_LE(burst_s, turn_max_s + kLagMax_s) << speed << " " << stall_s;
      EXPECT_GE(burst_s, std::min(speed * stall_s, 2.0 * kTurn_s * speed) - kTick_s);
    }
  }
}

TEST(Pace, GoesOnAtItsSpeedAfterGivingUp) {
  for (const double speed : kSpeeds) {
    Follower vehicle(speed);
    const double stall_s = 100.0;
    vehicle.turn(stall_s);
    EXPECT_EQ(vehicle.has_given_up, true) << speed;
    const std::int64_t begin = vehicle.tick;
    for (int turn = 1; turn <= 2000; ++turn) vehicle.turn(stall_s + turn * kTurn_s);
    EXPECT_NEAR(simulated_s(vehicle.tick - begin), speed * 2000 * kTurn_s, 2.0 * kTick_s) << speed;
  }
}

}  // namespace
}  // namespace gnbv
