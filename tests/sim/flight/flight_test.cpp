// Laws of every Flight, and of the ideal one.
#include "sim/flight/flight.hpp"

#include <gtest/gtest.h>

#include "scenarios/builtin.hpp"
#include "sim/core/error.hpp"
#include "sim/mesh/world.hpp"
#include "tests/sim/flight/bare_vehicle.hpp"
#include "tests/sim/flight/px4_client.hpp"
#include "tests/support/streaming_flight.hpp"

namespace gnbv {
namespace {

/// A quadrotor, and an ideal vehicle.
const std::vector<VehicleConfig> kBoth = [] {
  std::vector<VehicleConfig> both(2);
  both[1].kind = VehicleKind::ideal;
  return both;
}();

const ViewPose kStart = {Vec3(0, 0, 5), 0.3};

TEST(Flight, StartsAtRestWhereItIsTold) {
  for (const VehicleConfig& vehicle : kBoth) {
    const auto flight = streaming(make_flight(vehicle, World{}, kStart, 1));
    EXPECT_EQ(flight->tick(), 0);
    EXPECT_TRUE(flight->state().T_world_body.isApprox(T_world_body(kStart), 1e-15));
    for (int i = 0; i < 250; ++i) flight->step();
    EXPECT_EQ(flight->tick(), 250);
    EXPECT_TRUE(flight->state().T_world_body.isApprox(T_world_body(kStart), 1e-9));
    EXPECT_FALSE(flight->has_collided());
  }
}

TEST(Flight, FlyingIntoAWallOrTheGroundIsACollision) {
  for (const auto& [start, goal_m] : {std::pair(kStart, Vec3(6, 0, 5)),
                                      std::pair(ViewPose{Vec3(0, 0, 1), 0.0}, Vec3(0, 0, -2))}) {
    const auto flight = streaming(make_flight({}, walled_world(), start, 1));
    flight->command(go_to(goal_m, start.yaw_rad));
    for (int i = 0; i < 1500; ++i) flight->step();
    EXPECT_TRUE(flight->has_collided());
    const Isometry T = flight->state().T_world_body;
    EXPECT_TRUE(T.matrix().allFinite());
    EXPECT_LT(T.translation().x(), 3.0);
    EXPECT_GT(T.translation().z(), 0.0);
  }
}

TEST(Flight, HoverDrawsHoverPower) {
  for (const VehicleConfig& vehicle : kBoth) {
    const auto flight = streaming(make_flight(vehicle, World{}, kStart, 1));
    for (int i = 0; i < 36 * kTicksPerSecond; ++i) flight->step();
    EXPECT_NEAR(flight->energy_wh(), 1.85, 0.005);  // 185 W for a hundredth of an hour
  }
}

TEST(IdealFlight, IsWhereTheSetpointIs) {
  const auto flight = make_flight(kBoth[1], walled_world(), kStart, 1);
  const ViewPose there = {Vec3(6, -2, 9), -2.5};
  flight->command(go_to(there.p_world_m, there.yaw_rad));
  flight->step();
  EXPECT_EQ(flight->state().T_world_body.matrix(), T_world_body(there).matrix());
  EXPECT_FALSE(flight->has_collided());  // it has no body
}

TEST(IdealFlight, IntegratesVelocityAndYawRate) {
  const auto flight = make_flight(kBoth[1], World{}, kStart, 1);
  Setpoint setpoint = fly_at(Vec3(1, -2, 0.5));
  setpoint.yaw_rate_rad_s = 0.4;
  flight->command(setpoint);
  for (int i = 0; i < 250; ++i) flight->step();
  EXPECT_TRUE(flight->state().T_world_body.isApprox(
      T_world_body({kStart.p_world_m + Vec3(1, -2, 0.5), 0.7}), 1e-12));
  EXPECT_EQ(flight->state().v_world_m_s, Vec3(1, -2, 0.5));
}

/// Where an ideal vehicle that lands from 3 m comes to rest, within a minute.
double landed_z_m(const World& world) {
  const auto flight = make_flight(kBoth[1], world, {Vec3(0.2, 0.1, 3), 0.0}, 1);
  flight->land();
  for (int i = 0; i < 60 * kTicksPerSecond && !flight->has_landed(); ++i) flight->step();
  return flight->has_landed() ? flight->state().T_world_body.translation().z() : kNan;
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

// Laws of the rigid vehicle and its rotors, from closed forms (sheet: model C, the modern Iris).

const AirframeParameters kIris;

VehicleState at_height(double z_m) {
  VehicleState state;
  state.T_world_body.translation() = Vec3(0, 0, z_m);
  return state;
}

double energy_j(const VehicleState& state) {
  return 0.5 * state.omega_body_rad_s.dot(kIris.inertia_kg_m2.cwiseProduct(state.omega_body_rad_s));
}

Vec3 angular_momentum(const VehicleState& state) {
  return state.T_world_body.linear() * kIris.inertia_kg_m2.cwiseProduct(state.omega_body_rad_s);
}

TEST(Rotors, HoverCommandLiftsTheWeight) {
  EXPECT_NEAR(hover_command(kIris), 0.7067, 1e-3);  // the sheet's value
  RotorCommands commands{};
  commands.fill(hover_command(kIris));
  const Wrench wrench =
      rotor_wrench(kIris, reference_speeds(kIris, commands), Vec3::Zero(), Vec3::Zero());
  EXPECT_NEAR(wrench.thrust_n, kIris.mass_kg * kIris.gravity_m_s2, 1e-12);  // rounding
  EXPECT_NEAR(wrench.torque_body_n_m.norm(), 0.0, 1e-12);
}

TEST(Rotors, FollowsAStepInItsTimeConstantInAnyTicks) {
  const double share = 1.0 - std::exp(-1.0);  // 63.2 %
  EXPECT_NEAR(rotor_speed_after(rotor_lag(kIris, 0.0125), 100.0, 200.0), 100.0 + 100.0 * share,
              1e-9);
  EXPECT_NEAR(rotor_speed_after(rotor_lag(kIris, 0.025), 200.0, 100.0), 200.0 - 100.0 * share,
              1e-9);
  const double half = rotor_speed_after(rotor_lag(kIris, 0.5 * kTick_s), 300.0, 900.0);
  EXPECT_NEAR(rotor_speed_after(rotor_lag(kIris, 0.5 * kTick_s), half, 900.0),
              rotor_speed_after(rotor_lag(kIris, kTick_s), 300.0, 900.0),
              1e-9);  // exact ZOH, rounding
}

TEST(Rotors, ClockwiseRotorsTurnTheBodyCounterClockwise) {
  const Wrench wrench = rotor_wrench(kIris, {800, 800, 810, 810}, Vec3::Zero(), Vec3::Zero());
  EXPECT_NEAR(wrench.torque_body_n_m.z(), 0.06 * 5.84e-6 * 2.0 * (810.0 * 810.0 - 800.0 * 800.0),
              1e-12);
}

TEST(Rotors, DragOpposesInPlaneMotionOnly) {
  const Wrench wrench = rotor_wrench(kIris, all(800), Vec3(3, -4, 0), Vec3::Zero());
  const Vec3 drag_n = -4.0 * 800.0 * 1.75e-4 * Vec3(3, -4, 0);
  EXPECT_NEAR(wrench.force_body_n.x(), drag_n.x(), 1e-12);
  EXPECT_NEAR(wrench.force_body_n.y(), drag_n.y(), 1e-12);
  const Wrench climbing = rotor_wrench(kIris, all(800), Vec3(0, 0, 5), Vec3::Zero());
  EXPECT_NEAR(climbing.thrust_n, 0.8 * wrench.thrust_n, 1e-12);  // 1 - 5/25
}

TEST(RigidVehicle, FallsFreelyWithMotorsOffAndHoversAtHoverSpeed) {
  RigidVehicle falling(kIris, empty_world(), at_height(0.0), all(0.0));
  step(falling, all(0.0), 500);
  // the integration is exact under constant force: only rounding remains
  EXPECT_NEAR(falling.state().T_world_body.translation().z(), -19.6132, 1e-9);
  EXPECT_NEAR(falling.state().v_world_m_s.z(), -19.6132, 1e-9);
  RigidVehicle hovering(kIris, empty_world(), at_height(3.0), all(hover_speed_rad_s(kIris)));
  step(hovering, all(hover_speed_rad_s(kIris)), 2500);
  EXPECT_NEAR((hovering.state().T_world_body.translation() - Vec3(0, 0, 3)).norm(), 0.0, 1e-9);
}

TEST(RigidVehicle, TorqueFreeRotationConservesAngularMomentumAndEnergy) {
  VehicleState start = at_height(0.0);
  start.omega_body_rad_s = Vec3(2.0, 4.0, 1.0);  // near the unstable axis: it tumbles
  RigidVehicle vehicle(kIris, empty_world(), start, all(0.0));
  const Vec3 L0 = angular_momentum(start);
  const double E0 = energy_j(start);
  double worst_L = 0.0;
  double worst_E = 0.0;
  for (int i = 0; i < 10 * kTicksPerSecond; ++i) {
    step(vehicle, all(0.0));
    worst_L = std::max(worst_L, (angular_momentum(vehicle.state()) - L0).norm() / L0.norm());
    worst_E = std::max(worst_E, std::abs(energy_j(vehicle.state()) - E0) / E0);
  }
  EXPECT_LT(worst_L, 1e-12);                     // kept as state: rounding
  EXPECT_LT(worst_E, 1e-6);                      // second order in the 16 mrad turned per tick
  start.omega_body_rad_s = Vec3(0.0, 0.0, 1.5);  // a principal axis
  RigidVehicle spinning(kIris, empty_world(), start, all(0.0));
  step(spinning, all(0.0), kTicksPerSecond);
  EXPECT_NEAR(yaw_of(spinning.state().T_world_body), 1.5, 1e-12);  // rounding
}

TEST(RigidVehicle, TouchesAWallWhereItsHullEnds) {
  VehicleState start = at_height(5.0);
  start.v_world_m_s = Vec3(5.0, 0.0, 0.0);
  AirframeParameters weightless = kIris;
  weightless.gravity_m_s2 = 0.0;
  RigidVehicle vehicle(weightless, walled_world(), start, all(0.0));
  double x_touch_m = 0.0;
  for (int i = 0; i < 500 && !has_collided(vehicle); ++i) {
    step(vehicle, all(0.0));
    x_touch_m = vehicle.state().T_world_body.translation().x();
  }
  ASSERT_TRUE(has_collided(vehicle));
  // 20 mm a tick, and Bullet may see the contact one tick early or late
  EXPECT_NEAR(x_touch_m, 3.0 - kIris.hull_radius_m, 0.041);
  step(vehicle, all(0.0), 500);
  EXPECT_TRUE(has_collided(vehicle));
  EXPECT_LT(vehicle.state().T_world_body.translation().x(), 3.0);  // not through it
}

TEST(RigidVehicle, PassesAWallOneMillimetreAwayButNotOneMillimetreInside) {
  for (const float gap_m : {0.001F, -0.001F}) {
    const World world = walled_world(static_cast<float>(kIris.hull_radius_m) + gap_m);
    AirframeParameters weightless = kIris;
    weightless.gravity_m_s2 = 0.0;
    VehicleState start = at_height(5.0);
    start.v_world_m_s = Vec3(0.0, 2.0, 0.0);
    RigidVehicle vehicle(weightless, world, start, all(0.0));
    step(vehicle, all(0.0), 500);
    EXPECT_EQ(has_collided(vehicle), gap_m < 0.0F);
  }
}

TEST(RigidVehicle, LandsOnTheGroundPlaneAndStaysAboveIt) {
  RigidVehicle vehicle(kIris, World{}, at_height(1.0), all(0.0));
  step(vehicle, all(0.0), 1000);
  EXPECT_TRUE(has_collided(vehicle));
  // Bullet lets a resting body sink by a few mm
  EXPECT_NEAR(vehicle.state().T_world_body.translation().z(), 0.5 * kIris.hull_height_m, 0.01);
  RigidVehicle groundless(kIris, empty_world(), at_height(1.0), all(0.0));
  step(groundless, all(0.0), 1000);
  EXPECT_FALSE(has_collided(groundless));
}

TEST(RigidVehicle, FeelsTheLastFaceOfAnyNumber) {
  World world = empty_world();
  world.terrain.vertices_m = {{50, 0, 0},  {51, 0, 0}, {50, 1, 0},
                              {-9, -9, 0}, {9, -9, 0}, {0, 9, 0}};
  world.terrain.faces.assign((std::size_t{1} << 21U) + 1, {0, 1, 2});  // more than Bullet's 21 bits
  world.terrain.faces.back() = {3, 4, 5};
  RigidVehicle vehicle(kIris, world, at_height(1.0), all(0.0));
  step(vehicle, all(0.0), 500);
  EXPECT_TRUE(vehicle.has_touched_ground());
}

TEST(Flight, NanThrowsBrokenInvariant) {
  RigidVehicle vehicle(kIris, empty_world(), at_height(0.0), all(0.0));
  EXPECT_THROW(step(vehicle, all(kNan)), BrokenInvariant);
  EXPECT_THROW(RigidVehicle(kIris, empty_world(), at_height(kNan), all(0.0)), BrokenInvariant);
  for (const VehicleConfig& kind : kBoth) {
    EXPECT_THROW(make_flight(kind, World{}, {Vec3::Constant(kNan), 0.0}, 1), BrokenInvariant);
  }
}

}  // namespace
}  // namespace gnbv
