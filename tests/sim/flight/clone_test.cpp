// A vehicle that is copied, and one that is far from everything: bit by bit as the other one.
#include <gtest/gtest.h>

#include <stdexcept>

#include "sim/flight/flight.hpp"
#include "sim/mesh/world.hpp"
#include "tests/sim/flight/px4_client.hpp"

namespace gnbv {
namespace {

const ViewPose kStart = {Vec3(0, 0, 5), 0.3};

/// Flies a square with turns for that long, and tells each state.
std::vector<VehicleState> flown_square(Flight& flight, int ticks) {
  std::vector<VehicleState> states;
  for (int i = 0; i < ticks; ++i) {
    const double side = flight.tick() / 250 % 2 == 0 ? 1.0 : -1.0;
    if (i % 5 == 0) flight.command(go_to(Vec3(side, -side, 5.0 + 0.1 * side), side));
    flight.step();
    states.push_back(flight.state());
    states.push_back(flight.estimate());
  }
  return states;
}

void expect_same(const std::vector<VehicleState>& a, const std::vector<VehicleState>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].T_world_body.matrix(), b[i].T_world_body.matrix()) << i;
    ASSERT_EQ(a[i].v_world_m_s, b[i].v_world_m_s) << i;
    ASSERT_EQ(a[i].omega_body_rad_s, b[i].omega_body_rad_s) << i;
  }
}

TEST(Flight, ACloneFliesOnBitByBitAndApart) {
  for (const VehicleKind kind : {VehicleKind::quadrotor, VehicleKind::ideal}) {
    VehicleConfig vehicle;
    vehicle.kind = kind;
    vehicle.estimate.model = EstimateModel::gnss;
    const World world = walled_world(3.0F);
    const WindConfig wind = {.mean_world_m_s = Vec3(2, 1, 0), .gust_w20_m_s = 5.0};
    const auto flight = make_flight(vehicle, world, kStart, 3, wind);
    flown_square(*flight, 333);
    const auto clone = flight->clone();
    EXPECT_EQ(clone->tick(), 333);
    const auto expected = flown_square(*flight, 500);
    expect_same(flown_square(*clone, 500), expected);
    EXPECT_EQ(clone->energy_wh(), flight->energy_wh());
    EXPECT_EQ(clone->has_collided(), flight->has_collided());
  }
}

TEST(Flight, WhatTouchesSomethingIsNotCloned) {
  const auto flight = make_flight({}, walled_world(1.0F), kStart, 1);
  for (int i = 0; i < 750 && !flight->has_collided(); ++i) {
    flight->command(go_to(Vec3(4, 0, 5), 0.3));
    flight->step();
  }
  ASSERT_TRUE(flight->has_collided());
  EXPECT_THROW(static_cast<void>(flight->clone()), std::runtime_error);
}

/// Oracle: Bullet, which looks for contacts wherever the box of a mesh is near.
TEST(RigidVehicle, FarFromEverythingItMovesAsBulletMovesIt) {
  World near = walled_world(100.0F);
  near.structure.vertices_m.insert(near.structure.vertices_m.end(),
                                   {{-100, -99, -99}, {-100, -99, -98}, {-100, -98, -99}});
  near.structure.faces.push_back({4, 5, 6});
  const auto by_bullet = make_flight({}, near, kStart, 1);
  const auto alone = make_flight({}, World{}, kStart, 1);
  expect_same(flown_square(*alone, 1500), flown_square(*by_bullet, 1500));
}

}  // namespace
}  // namespace gnbv
