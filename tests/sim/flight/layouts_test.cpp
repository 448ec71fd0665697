// Any layout of four to eight rotors flies: hover, a turn, a waypoint; what cannot is named.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "scenarios/builtin.hpp"
#include "sim/core/rng.hpp"
#include "sim/flight/guidance.hpp"
#include "sim/flight/quadrotor.hpp"
#include "sim/flight/rotors.hpp"
#include "sim/mesh/world.hpp"
#include "tests/support/streaming_flight.hpp"

namespace gnbv {
namespace {

using testing::HasSubstr;

/// Rotors on a circle around a point, the first at that bearing, spins alternating.
std::vector<RotorMount> ring(int rotors, double first_deg, const Vec3& around_m = Vec3::Zero()) {
  std::vector<RotorMount> mounts;
  for (int i = 0; i < rotors; ++i) {
    const double bearing_rad = deg_to_rad(first_deg + 360.0 * i / rotors);
    mounts.push_back({around_m + 0.25 * Vec3(std::cos(bearing_rad), std::sin(bearing_rad), 0.0),
                      i % 2 == 0 ? 1.0 : -1.0});
  }
  return mounts;
}

/// Two rotors on each arm of an X, one above the other.
std::vector<RotorMount> coaxial() {
  std::vector<RotorMount> mounts = ring(4, 45.0);
  for (RotorMount below : ring(4, 45.0, Vec3(0, 0, -0.05))) {
    below.spin = -below.spin;
    mounts.push_back(below);
  }
  return mounts;
}

struct Layout {
  std::string name;
  std::vector<RotorMount> rotors;
};

const std::vector<Layout> kLayouts = {
    {"quad_plus", ring(4, 0.0)},
    {"quad_x", ring(4, 45.0)},
    {"quad_h",
     {{{0.4, -0.1, 0}, 1}, {{-0.4, 0.1, 0}, 1}, {{0.4, 0.1, 0}, -1}, {{-0.4, -0.1, 0}, -1}}},
    {"quad_heavy_nose", ring(4, 45.0, Vec3(-0.05, 0.02, 0))},
    {"hexa_plus", ring(6, 0.0)},
    {"hexa_x", ring(6, 30.0)},
    {"octo_plus", ring(8, 0.0)},
    {"octo_x", ring(8, 22.5)},
    {"octo_coaxial", coaxial()}};

class Layouts : public testing::TestWithParam<Layout> {};

TEST_P(Layouts, HoversTurnsAndFliesToAWaypoint) {
  VehicleConfig vehicle;
  vehicle.airframe.rotors = GetParam().rotors;
  ASSERT_EQ(allocation_fault(vehicle.airframe), "");
  const ViewPose start = {Vec3(0, 0, 10), 0.0};
  const auto flight = streaming(make_flight(vehicle, World{}, start, 1));
  const GuidanceConfig guidance;
  const auto fly_to = [&](const ViewPose& goal) {
    return fly_leg(*flight, goal, guidance.path_speed_m_s, guidance, vehicle, nullptr);
  };
  double drift_m = 0.0;
  double turned_rad = 0.0;
  for (int i = 0; i < 4 * kTicksPerSecond; ++i) {
    flight->step();
    const Isometry T = flight->state().T_world_body;
    drift_m = std::max(drift_m, (T.translation() - start.p_world_m).norm());
    turned_rad = std::max(turned_rad, std::abs(yaw_of(T)));
  }
  EXPECT_LT(drift_m, 0.3);  // an uneven one levels itself first: thrust is no line in the command
  EXPECT_LT(turned_rad, deg_to_rad(1.0));
  ASSERT_EQ(fly_to({start.p_world_m, deg_to_rad(120.0)}), LegEnd::arrived);
  EXPECT_NEAR(yaw_of(flight->state().T_world_body), deg_to_rad(120.0), deg_to_rad(3.0));
  EXPECT_LT((flight->state().T_world_body.translation() - start.p_world_m).norm(), 0.12);
  const ViewPose goal = {Vec3(6, -4, 12), deg_to_rad(-90.0)};
  ASSERT_EQ(fly_to(goal), LegEnd::arrived);
  EXPECT_LT((flight->state().T_world_body.translation() - goal.p_world_m).norm(), 0.12);
}

/// Below saturation the rotors give the torque that is asked for, and no other, in the true units.
TEST_P(Layouts, GiveTheTorqueThatIsAskedAndNoOther) {
  AirframeParameters airframe;
  airframe.rotors = GetParam().rotors;
  airframe.idle_speed_rad_s = 0.0;
  const Allocation allocation = allocation_of(airframe);
  const auto torque_of = [&](const RotorCommands& commands) {
    // of thrusts that are linear in the commands
    RotorSpeeds speeds{};
    for (std::size_t i = 0; i < 8; ++i) speeds[i] = std::sqrt(commands[i]) * 1000.0;
    return rotor_wrench(airframe, speeds, Vec3::Zero(), Vec3::Zero()).torque_body_n_m;
  };
  for (int axis = 0; axis < 3; ++axis) {
    const MixerOutput out = mix(allocation, 0.05 * Vec3::Unit(axis), 0.5);
    EXPECT_LT((out.torque - 0.05 * Vec3::Unit(axis)).norm(), 1e-9);
    const Vec3 torque_n_m = torque_of(out.commands);
    EXPECT_GT(torque_n_m[axis], 0.01);
    for (int other = 0; other < 3; ++other) {
      if (other == axis) continue;
      EXPECT_NEAR(torque_n_m[other] / torque_n_m[axis], 0.0, 1e-9);
    }
  }
}

TEST_P(Layouts, CommandsStayWithinTheirBounds) {
  AirframeParameters airframe;
  airframe.rotors = GetParam().rotors;
  const Allocation allocation = allocation_of(airframe);
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const auto random = [&](std::uint64_t k) {
      return 2e-9 * static_cast<double>(random_bits({3, Stream::bench, i, k}) % 1'000'000'000) - 1;
    };
    const Vec3 torque(2.0 * random(0), 2.0 * random(1), 2.0 * random(2));
    const MixerOutput out = mix(allocation, torque, 0.5 + 0.5 * random(3));
    for (const double command : out.commands) {
      ASSERT_GE(command, 0.0);
      ASSERT_LE(command, 1.0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, Layouts, testing::ValuesIn(kLayouts),
                         [](const auto& layout) { return layout.param.name; });

TEST(Allocation, QuadsInAnXAreAllocatedByTheirQuadrants) {
  const double half = 0.5 * std::numbers::sqrt2;
  for (const std::string_view preset : builtin_names("vehicles")) {
    const Allocation quad = allocation_of(vehicle_preset(preset).airframe);
    EXPECT_EQ(quad.torque[0].command, (RotorValues{-half, half, half, -half}));
    EXPECT_EQ(quad.torque[1].command, (RotorValues{-half, half, -half, half}));
    EXPECT_EQ(quad.torque[2].command, (RotorValues{-1, -1, 1, 1}));
    EXPECT_EQ(quad.thrust, (RotorValues{1, 1, 1, 1}));
  }
}

TEST(Allocation, WhatCannotSteerIsNamed) {
  AirframeParameters airframe;
  airframe.moment_per_thrust_m = 0.0;
  EXPECT_THAT(allocation_fault(airframe), HasSubstr("moment_per_thrust_m is 0"));
  airframe = {};
  for (RotorMount& rotor : airframe.rotors) rotor.spin = 1.0;
  EXPECT_THAT(allocation_fault(airframe), HasSubstr("cannot give yaw apart from thrust"));
  airframe = {};
  for (RotorMount& rotor : airframe.rotors) rotor.p_body_m.y() = 0.0;
  EXPECT_THAT(allocation_fault(airframe), HasSubstr("cannot give roll"));
  airframe.rotors = ring(6, 0.0, Vec3(0.4, 0, 0));
  EXPECT_THAT(allocation_fault(airframe), HasSubstr("centre of mass"));
}

// Laws of the allocation to rotors: what is asked is given, and what gives way first.

const AirframeParameters kIris;
const Allocation kQuad = allocation_of(kIris);

TEST(Mixer, SacrificesYawBeforeRoll) {
  const MixerOutput out = mix(kQuad, Vec3(0.4, 0.0, 0.6), 1.0);
  EXPECT_NEAR(out.torque.x(), 0.4, 1e-12);
  EXPECT_NEAR(out.torque.z(), 0.15, 1e-12);  // what the headroom leaves
  // beyond the headroom's reach roll gives way a little, yaw most of itself
  const MixerOutput extreme = mix(kQuad, Vec3(0.6, 0.0, 0.6), 1.0);
  EXPECT_GT(extreme.torque.x(), 0.9 * 0.6);
  EXPECT_LT(extreme.torque.z(), 0.3 * 0.6);
}

TEST(Mixer, SacrificesThrustBeforeRollAndNeverRaisesItForAttitude) {
  const auto mean = [](const MixerOutput& out) {
    return 0.25 * std::accumulate(out.commands.begin(), out.commands.begin() + 4, 0.0);
  };
  const MixerOutput out = mix(kQuad, Vec3(0.5, 0.0, 0.0), 1.0);
  EXPECT_NEAR(out.torque.x(), 0.5, 1e-12);
  EXPECT_NEAR(mean(out), 1.0 - 0.5 * std::sqrt(0.5), 1e-12);  // the higher pair just reaches 1
  for (const double thrust : {0.0, 0.05, 0.1}) {              // airmode off
    EXPECT_LE(mean(mix(kQuad, Vec3(0.4, 0.3, 0.2), thrust)), thrust + 1e-12);
  }
}

// What a flight was foretold to draw against what it drew.

TEST(LegEnergy, IsWhatALegDrawsAndNeverLess) {
  const VehicleConfig iris;
  const GuidanceConfig guidance;
  const Vec3 from_m(0, 0, 10);
  for (const ViewPose& to :
       {ViewPose{{0.5, 0, 10}, 0.0}, ViewPose{{30, 0, 10}, 0.0}, ViewPose{{0, 0, 40}, 0.0},
        ViewPose{{-10, 4, 4}, 0.0}, ViewPose{{0, 0, 10}, kPi}, ViewPose{{0.5, 0, 10}, -2.0}}) {
    const auto flight = make_flight(iris, World{}, {from_m, 0.0}, 1);
    ASSERT_EQ(fly_leg(*flight, to, guidance.path_speed_m_s, guidance, iris, {}), LegEnd::arrived);
    const double foretold_wh = leg_energy_wh(iris, guidance, {from_m, 0.0}, to);
    const double allowance_wh = hover_power_w(iris) * kArrival_s / kJoulesPerWattHour;
    EXPECT_LT(flight->energy_wh(), foretold_wh) << to.p_world_m.transpose() << ", " << to.yaw_rad;
    EXPECT_GT(flight->energy_wh(), 0.97 * (foretold_wh - allowance_wh))
        << to.p_world_m.transpose() << ", " << to.yaw_rad;
  }
}

TEST(LegEnergy, OfATurnAloneOrAnIdealVehicleIsHoverPowerTimesItsTime) {
  const VehicleConfig iris;
  VehicleConfig ideal;
  ideal.kind = VehicleKind::ideal;
  const GuidanceConfig guidance;
  const auto hover_s = [&](const VehicleConfig& vehicle, const ViewPose& from, const ViewPose& to) {
    return leg_energy_wh(vehicle, guidance, from, to) * kJoulesPerWattHour / hover_power_w(vehicle);
  };
  const ViewPose from = {Vec3(1, 2, 3), 3.0};
  for (const double yaw_rad : {-2.0, 1.0, 3.0 - kPi}) {  // either way round
    const ViewPose to = {from.p_world_m, yaw_rad};
    const double duration_s = leg_duration_s(from, to, 1.0, guidance, iris);
    EXPECT_GT(duration_s, 1.0);
    EXPECT_NEAR(hover_s(iris, from, to), duration_s + kArrival_s, 1e-8);
  }
  EXPECT_EQ(hover_s(iris, from, from), 0.0);
  // 30 m at 2 m/s, 1 m/s^2 and 4 m/s^3: 30 / 2 + 2 / 1 + 1 / 4 seconds
  EXPECT_NEAR(hover_s(ideal, {Vec3(0, 0, 1), 0.0}, {Vec3(0, 0, 31), 0.0}),
              15.0 + 2.0 + 0.25 + kArrival_s, 1e-8);
}

}  // namespace
}  // namespace gnbv
