// A vehicle that is hit by what moves.
#include <gtest/gtest.h>

#include "tests/sim/flight/px4_client.hpp"

namespace gnbv {
namespace {

/// A cube of 1 m that comes along x at 2 m/s; its front face is at x = -4 at first.
World world_with_cube() {
  World world{.structure = {}, .has_ground = true};
  world.movers = {{box_mesh({Vec3(-5, -0.5, 4.5), Vec3(-4, 0.5, 5.5)}), {{{20, 0, 0}}, 2.0}}};
  return world;
}
const ViewPose kHover = {Vec3(0, 0, 5), 0.3};

/// For ten seconds, or until it is hit; when that was.
double hovered_s(Flight& flight, const ViewPose& at = kHover) {
  while (!flight.has_collided() && flight.tick() < 10 * kTicksPerSecond) {
    flight.command(go_to(at.p_world_m, at.yaw_rad));
    flight.step();
  }
  return static_cast<double>(flight.tick()) * kTick_s;
}

TEST(MovingBody, HitsAHoveringVehicleWhenItsFaceComesToTheHull) {
  const VehicleConfig vehicle;
  const auto flight = make_flight(vehicle, world_with_cube(), kHover, 1);
  const double at_s = hovered_s(*flight);
  ASSERT_TRUE(flight->has_collided());
  const double expected_s = (4.0 - vehicle.airframe.hull_radius_m) / 2.0;
  EXPECT_NEAR(at_s, expected_s, 0.02);  // hovering it sways by millimetres
}

TEST(MovingBody, IsWhereTheClockOfACloneHasIt) {
  const auto flight = make_flight({}, world_with_cube(), kHover, 1);
  for (int i = 0; i < 100; ++i) {
    flight->command(go_to(kHover.p_world_m, kHover.yaw_rad));
    flight->step();
  }
  const auto clone = flight->clone();
  EXPECT_EQ(hovered_s(*clone), hovered_s(*flight));
}

TEST(MovingBody, LeavesWhoeverIsBesideItsWayAlone) {
  const ViewPose beside = {Vec3(0, 1.2, 5), 0.3};
  const auto flight = make_flight({}, world_with_cube(), beside, 1);
  hovered_s(*flight, beside);
  EXPECT_FALSE(flight->has_collided());
}

}  // namespace
}  // namespace gnbv
