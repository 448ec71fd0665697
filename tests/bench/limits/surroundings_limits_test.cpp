// Obstacles and no_fly boxes take legal viewpoints as the structure does.
#include <gtest/gtest.h>

#include <algorithm>

#include "bench/limits/lattice_ways.hpp"
#include "bench/limits/legal_viewpoints.hpp"
#include "tests/bench/shapes.hpp"

namespace gnbv {
namespace {

constexpr double kRadius_m = 0.5;
const Box3 kRoom(Vec3(-4, -4, 0), Vec3(4, 4, 4));
const Box3 kBlock(Vec3(-1, -2, 0.5), Vec3(1.5, 1, 2.5));
const Vec3 kStart(-3, -3, 1);

LegalViewpoints legal_in(const World& world, const NoFly& no_fly = {}) {
  return find_legal_viewpoints(RayScene(world), kRoom, kRadius_m, 0.4, kStart, 2, no_fly);
}

TEST(SurroundingsLimits, AnObstacleTakesTheRoomOfAStructureOfItsShape) {
  World structure;
  structure.structure = box_mesh(kBlock);
  World obstacle;
  test::add_sheet(obstacle.structure, Vec3(50, 50, 50), Vec3(1, 0, 0), Vec3(0, 1, 0));
  obstacle.obstacles = box_mesh(kBlock);
  const LegalViewpoints by_structure = legal_in(structure);
  const LegalViewpoints by_obstacle = legal_in(obstacle);
  EXPECT_EQ(by_obstacle.p_world_m, by_structure.p_world_m);
  EXPECT_EQ(by_obstacle.neighbours, by_structure.neighbours);
  EXPECT_LT(by_obstacle.size(), 21U * 21U * 11U);
}

TEST(SurroundingsLimits, NoViewpointAndNoWayComesNearerToANoFlyBoxThanTheRadius) {
  World far_away;
  test::add_sheet(far_away.structure, Vec3(50, 50, 50), Vec3(1, 0, 0), Vec3(0, 1, 0));
  const NoFly no_fly{{kBlock}, kRadius_m};
  const RayScene scene(far_away);
  const LegalViewpoints legal =
      find_legal_viewpoints(scene, kRoom, kRadius_m, 0.4, kStart, 2, no_fly);
  EXPECT_GT(legal.size(), 1000U);
  EXPECT_LT(legal.size(), 21U * 21U * 11U);
  for (const Vec3& p_m : legal.p_world_m) EXPECT_GE(kBlock.exteriorDistance(p_m), kRadius_m);

  const auto at = [&](const Vec3& p_m) {
    return static_cast<std::size_t>(std::min_element(legal.p_world_m.begin(), legal.p_world_m.end(),
                                                     [&](const Vec3& a, const Vec3& b) {
                                                       return (a - p_m).norm() < (b - p_m).norm();
                                                     }) -
                                    legal.p_world_m.begin());
  };
  LatticeWays ways(scene, legal, kRadius_m);
  const std::size_t from = at({-3, -0.5, 1.5});
  const std::size_t to = at({3.5, -0.5, 1.5});
  ways.prepare({from}, 1);
  const Way way = ways.way(from, to);
  ASSERT_FALSE(way.via_world_m.empty());  // straight through the box otherwise
  Vec3 at_m = legal.p_world_m[from];
  std::vector<Vec3> points_m = way.via_world_m;
  points_m.push_back(legal.p_world_m[to]);
  for (const Vec3& next_m : points_m) {
    for (int i = 0; i <= 100; ++i) {
      const Vec3 p_m = at_m + 0.01 * i * (next_m - at_m);
      EXPECT_GE(kBlock.exteriorDistance(p_m), kRadius_m - 1e-3);
    }
    at_m = next_m;
  }
}

}  // namespace
}  // namespace gnbv
