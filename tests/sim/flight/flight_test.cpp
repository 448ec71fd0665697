// Laws of every Flight, and of the ideal one.
#include "sim/flight/flight.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "scenarios/builtin.hpp"
#include "sim/core/error.hpp"
#include "sim/mesh/world.hpp"
#include "tests/support/streaming_flight.hpp"

namespace gnbv {
namespace {

/// A wall of 20 m x 20 m at x = 3 m, seen from the origin.
World walled_world() {
  World world;
  world.structure.vertices_m = {{3, -10, 0}, {3, 10, 0}, {3, 10, 20}, {3, -10, 20}};
  world.structure.faces = {{0, 2, 1}, {0, 3, 2}};
  return world;
}

VehicleConfig kind(VehicleKind vehicle) {
  VehicleConfig config;
  config.kind = vehicle;
  return config;
}

Setpoint go_to(const Vec3& p_world_m, double yaw_rad) {
  Setpoint setpoint;
  setpoint.p_world_m = p_world_m;
  setpoint.yaw_rad = yaw_rad;
  return setpoint;
}

const ViewPose kStart = {Vec3(0, 0, 5), 0.3};

TEST(Flight, StartsAtRestWhereItIsTold) {
  for (const VehicleKind vehicle : {VehicleKind::quadrotor, VehicleKind::ideal}) {
    const auto flight = streaming(make_flight(kind(vehicle), World{}, kStart, 1));
    EXPECT_EQ(flight->tick(), 0);
    EXPECT_TRUE(flight->state().T_world_body.isApprox(T_world_body(kStart), 1e-15));
    for (int i = 0; i < 250; ++i) flight->step();
    EXPECT_EQ(flight->tick(), 250);
    EXPECT_TRUE(flight->state().T_world_body.isApprox(T_world_body(kStart), 1e-9));
    EXPECT_FALSE(flight->has_collided());
  }
}

TEST(Flight, FlyingIntoAWallIsACollision) {
  const auto flight = streaming(make_flight({}, walled_world(), kStart, 1));
  flight->command(go_to(Vec3(6, 0, 5), 0.3));
  for (int i = 0; i < 1500; ++i) flight->step();
  EXPECT_TRUE(flight->has_collided());
  EXPECT_LT(flight->state().T_world_body.translation().x(), 3.0);
  EXPECT_TRUE(flight->state().T_world_body.matrix().allFinite());
}

TEST(Flight, FlyingIntoTheGroundIsACollision) {
  const auto flight = streaming(make_flight({}, World{}, {Vec3(0, 0, 1), 0.0}, 1));
  flight->command(go_to(Vec3(0, 0, -2), 0.0));
  for (int i = 0; i < 1500; ++i) flight->step();
  EXPECT_TRUE(flight->has_collided());
  EXPECT_GT(flight->state().T_world_body.translation().z(), 0.0);
}

TEST(Flight, HoverDrawsHoverPower) {
  for (const VehicleKind vehicle : {VehicleKind::quadrotor, VehicleKind::ideal}) {
    const auto flight = streaming(make_flight(kind(vehicle), World{}, kStart, 1));
    for (int i = 0; i < 36 * kTicksPerSecond; ++i) flight->step();
    EXPECT_NEAR(flight->energy_wh(), 1.85, 0.005);  // 185 W for a hundredth of an hour
  }
}

TEST(Flight, NanStartThrowsBrokenInvariant) {
  const ViewPose nowhere = {Vec3::Constant(std::numeric_limits<double>::quiet_NaN()), 0.0};
  for (const VehicleKind vehicle : {VehicleKind::quadrotor, VehicleKind::ideal}) {
    EXPECT_THROW(make_flight(kind(vehicle), World{}, nowhere, 1), BrokenInvariant);
  }
}

TEST(IdealFlight, IsWhereTheSetpointIs) {
  const auto flight = make_flight(kind(VehicleKind::ideal), walled_world(), kStart, 1);
  const ViewPose there = {Vec3(6, -2, 9), -2.5};
  flight->command(go_to(there.p_world_m, there.yaw_rad));
  flight->step();
  EXPECT_EQ(flight->state().T_world_body.matrix(), T_world_body(there).matrix());
  EXPECT_FALSE(flight->has_collided());  // it has no body
}

TEST(IdealFlight, IntegratesVelocityAndYawRate) {
  const auto flight = make_flight(kind(VehicleKind::ideal), World{}, kStart, 1);
  Setpoint setpoint;
  setpoint.v_world_m_s = Vec3(1, -2, 0.5);
  setpoint.yaw_rate_rad_s = 0.4;
  flight->command(setpoint);
  for (int i = 0; i < 250; ++i) flight->step();
  EXPECT_TRUE(flight->state().T_world_body.isApprox(
      T_world_body({kStart.p_world_m + Vec3(1, -2, 0.5), 0.7}), 1e-12));
  EXPECT_EQ(flight->state().v_world_m_s, Vec3(1, -2, 0.5));
}

/// Where an ideal vehicle that lands from 3 m comes to rest, within a minute.
double landed_z_m(const World& world) {
  const auto flight = make_flight(kind(VehicleKind::ideal), world, {Vec3(0.2, 0.1, 3), 0.0}, 1);
  flight->land();
  for (int i = 0; i < 60 * kTicksPerSecond && !flight->has_landed(); ++i) flight->step();
  return flight->has_landed() ? flight->state().T_world_body.translation().z()
                              : std::numeric_limits<double>::quiet_NaN();
}

TEST(IdealFlight, LandsOnTheTerrainBelowIt) {
  const double step_m = vehicle_preset("iris").autopilot.commander.land_speed_m_s * kTick_s;
  EXPECT_NEAR(landed_z_m(World{}), 0.0, step_m);
  World slope{.structure = {}, .has_ground = false};  // z = 1 + x / 2
  slope.terrain.vertices_m = {{-2, -2, 0}, {2, -2, 2}, {2, 2, 2}, {-2, 2, 0}};
  slope.terrain.faces = {{0, 1, 2}, {0, 2, 3}};
  EXPECT_NEAR(landed_z_m(slope), 1.1, step_m);
  for (Vec3f& v : slope.terrain.vertices_m) v.z() -= 3.0F;
  EXPECT_NEAR(landed_z_m(slope), -1.9, step_m);
  EXPECT_TRUE(std::isnan(landed_z_m(World{.structure = {}, .has_ground = false})));
}

}  // namespace
}  // namespace gnbv
