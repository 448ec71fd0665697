#include "bench/limits/legal_viewpoints.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "bench/limits/lattice_ways.hpp"
#include "tests/bench/shapes.hpp"

namespace gnbv {
namespace {

constexpr double kRadius_m = 0.5;
const Box3 kRoom(Vec3(-4, -4, 0), Vec3(4, 4, 4));

/// A wall across the room at x = 0 with a door in its middle, from the floor to the ceiling and
/// beyond.
TriangleMesh wall_with_door(double door_m) {
  TriangleMesh mesh;
  const double half_m = 0.5 * door_m;
  test::add_sheet(mesh, Vec3(0, -9, -9), Vec3(0, 9 - half_m, 0), Vec3(0, 0, 18));
  test::add_sheet(mesh, Vec3(0, half_m, -9), Vec3(0, 9 - half_m, 0), Vec3(0, 0, 18));
  return mesh;
}

LegalViewpoints legal_in(const World& world, const Vec3& start, const NoFly& no_fly = {}) {
  return find_legal_viewpoints(RayScene(world), kRoom, kRadius_m, 0.4, start, 2, no_fly);
}
LegalViewpoints legal_in(const TriangleMesh& mesh, const Vec3& start) {
  return legal_in(World{mesh, true}, start);
}

/// A structure that is nowhere near.
TriangleMesh far_away() {
  TriangleMesh mesh;
  test::add_sheet(mesh, Vec3(50, 50, 50), Vec3(1, 0, 0), Vec3(0, 1, 0));
  return mesh;
}

std::size_t nearest_to(const Vec3& p_m, const LegalViewpoints& legal) {
  const auto nearest = std::min_element(
      legal.p_world_m.begin(), legal.p_world_m.end(),
      [&](const Vec3& a, const Vec3& b) { return (a - p_m).norm() < (b - p_m).norm(); });
  return static_cast<std::size_t>(nearest - legal.p_world_m.begin());
}

std::vector<Vec3> points_of(const LatticeWays& ways, std::size_t from, std::size_t to) {
  std::vector<Vec3> points_m = ways.way(from, to).via_world_m;
  EXPECT_FALSE(points_m.empty());  // something is in between
  points_m.insert(points_m.begin(), ways.p_world_m(from));
  points_m.push_back(ways.p_world_m(to));
  return points_m;
}

bool any_beyond_the_wall(const LegalViewpoints& legal) {
  return std::any_of(legal.p_world_m.begin(), legal.p_world_m.end(),
                     [](const Vec3& p) { return p.x() > 0.0; });
}

TEST(LegalViewpoints, LeadThroughADoorWiderThanTheSphereAndNoOther) {
  const Vec3 start(-2, 0, 2);
  EXPECT_TRUE(any_beyond_the_wall(legal_in(wall_with_door(2.0 * kRadius_m + 0.2), start)));
  EXPECT_FALSE(any_beyond_the_wall(legal_in(wall_with_door(2.0 * kRadius_m - 0.1), start)));
}

TEST(LegalViewpoints, LeaveOutARoomThatIsClosed) {
  TriangleMesh closed;
  const Box3 inner(Vec3(-2, -2, 1), Vec3(2, 2, 3.5));
  test::add_box(closed, inner.min(), inner.sizes());
  const LegalViewpoints outside = legal_in(closed, Vec3(-3.5, -3.5, 0.5));
  const LegalViewpoints inside = legal_in(closed, Vec3(0, 0, 2));
  EXPECT_GT(outside.size(), 0U);
  EXPECT_GT(inside.size(), 0U);
  for (const Vec3& p : outside.p_world_m) EXPECT_FALSE(inner.contains(p)) << p.transpose();
  for (const Vec3& p : inside.p_world_m) EXPECT_TRUE(inner.contains(p)) << p.transpose();
}

TEST(LegalViewpoints, FillAnEmptyRoomToItsFaces) {
  const LegalViewpoints legal = legal_in(far_away(), Vec3(0, 0, 1));
  EXPECT_EQ(legal.size(), 21U * 21U * 11U);  // 8 x 8 x 4 m in steps of 0.4 m, both ends included
  std::size_t inner = 0;
  for (const auto& neighbours : legal.neighbours) inner += neighbours.size() == 26 ? 1 : 0;
  EXPECT_EQ(inner, 19U * 19U * 9U);
}

TEST(LegalViewpoints, KeepTheRadiusOnEveryLeg) {
  // a pole in the middle between positions that are clear of it themselves
  TriangleMesh pole;
  test::add_box(pole, Vec3(0.18, 0.18, 0.0), Vec3(0.04, 0.04, 4.0));
  const World world{pole, true};
  const RayScene scene(world);
  const LegalViewpoints legal =
      find_legal_viewpoints(scene, kRoom, kRadius_m, 1.2, Vec3(-2, 0, 2), 2);
  ASSERT_EQ(legal.size(), 7U * 7U * 4U);
  for (std::size_t i = 0; i < legal.size(); ++i) {
    for (const std::uint32_t j : legal.neighbours[i]) {
      for (double t = 0.0; t <= 1.0; t += 0.05) {
        const Vec3 p = (1.0 - t) * legal.p_world_m[i] + t * legal.p_world_m[j];
        ASSERT_GE(scene.distance_to_structure_m(p, 10.0), kRadius_m - 1e-9);
      }
    }
  }
}

TEST(LegClearance, IsTheDistanceOfTheLegFromTheWall) {
  // along a wall the distance is known; what is within a centimetre of the radius may be refused
  const World world{wall_with_door(0.2), true};
  const RayScene scene(world);
  for (const double off_m : {-0.3, -0.02, 0.02, 0.3}) {
    const double x = -(kRadius_m + off_m);
    EXPECT_EQ(is_leg_clear(scene, Vec3(x, -3, 1), Vec3(x, 3, 3), kRadius_m), off_m > 0.0) << off_m;
  }
  EXPECT_FALSE(is_leg_clear(scene, Vec3(-3, 1, 1), Vec3(3, 1, 1), kRadius_m));  // through it
}

TEST(LatticeWays, GoRoundTheWallByTheDoor) {
  const World world{wall_with_door(1.4), true};
  const RayScene scene(world);
  const LegalViewpoints legal =
      find_legal_viewpoints(scene, kRoom, kRadius_m, 0.4, Vec3(-2, -3, 2), 2);
  LatticeWays ways(scene, legal, kRadius_m);
  ways.prepare({ways.start()}, 1);
  // the place that mirrors the start: the straight way is through the wall
  const std::size_t goal = nearest_to({2, -3, 2}, legal);
  const std::vector<Vec3> points = points_of(ways, ways.start(), goal);
  double length_m = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    length_m += (points[i] - points[i - 1]).norm();
    EXPECT_TRUE(is_leg_clear(scene, points[i - 1], points[i], kRadius_m));
  }
  EXPECT_NEAR(ways.way(ways.start(), goal).length_m, length_m, 1e-9);
  // a thread pulled round the door's edge at y = -0.7, half a metre away from it, is no shorter
  // than to the middle of its bend; the lattice's corners make it a little longer
  const double shortest_m = 2.0 * (Vec3(-2, -3, 2) - Vec3(0, -0.2, 2)).norm();
  EXPECT_GE(length_m, shortest_m - 2.0 * legal.step_m);
  EXPECT_LE(length_m, 1.15 * shortest_m);
  const std::vector<std::size_t> there = {goal};  // whose row is of the uncut way
  EXPECT_LE(length_m, static_cast<double>(ways.distances_m(ways.start(), there, 1)[0]) + 1e-5);
}

const Box3 kBlock(Vec3(-1, -2, 0.5), Vec3(1.5, 1, 2.5));
const Vec3 kStart(-3, -3, 1);

TEST(LegalViewpoints, AnObstacleTakesTheRoomOfAStructureOfItsShape) {
  World structure;
  structure.structure = box_mesh(kBlock);
  World obstacle{far_away()};
  obstacle.obstacles = box_mesh(kBlock);
  const LegalViewpoints by_structure = legal_in(structure, kStart);
  const LegalViewpoints by_obstacle = legal_in(obstacle, kStart);
  EXPECT_EQ(by_obstacle.p_world_m, by_structure.p_world_m);
  EXPECT_EQ(by_obstacle.neighbours, by_structure.neighbours);
  EXPECT_LT(by_obstacle.size(), 21U * 21U * 11U);
}

TEST(LegalViewpoints, NoViewpointAndNoWayComesNearerToANoFlyBoxThanTheRadius) {
  const NoFly no_fly{{kBlock}, kRadius_m};
  const RayScene scene(World{far_away()});
  const LegalViewpoints legal = legal_in(World{far_away()}, kStart, no_fly);
  EXPECT_GT(legal.size(), 1000U);
  EXPECT_LT(legal.size(), 21U * 21U * 11U);
  for (const Vec3& p_m : legal.p_world_m) EXPECT_GE(kBlock.exteriorDistance(p_m), kRadius_m);

  LatticeWays ways(scene, legal, kRadius_m);
  const std::size_t from = nearest_to({-3, -0.5, 1.5}, legal);
  ways.prepare({from}, 1);
  const std::vector<Vec3> points_m = points_of(ways, from, nearest_to({3.5, -0.5, 1.5}, legal));
  for (std::size_t k = 1; k < points_m.size(); ++k) {
    for (int i = 0; i <= 100; ++i) {
      const Vec3 p_m = points_m[k - 1] + 0.01 * i * (points_m[k] - points_m[k - 1]);
      EXPECT_GE(kBlock.exteriorDistance(p_m), kRadius_m - 1e-3);
    }
  }
}

/// Shortest ways from the start by going over all legs until nothing changes (Bellman 1958).
std::vector<double> relaxed_lengths_m(const LegalViewpoints& legal) {
  std::vector<double> length_m(legal.size(), std::numeric_limits<double>::infinity());
  for (const std::uint32_t place : legal.near_start) {
    length_m[place] = (legal.p_world_m[place] - legal.start_world_m).norm();
  }
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    for (std::size_t from = 0; from < legal.size(); ++from) {
      for (const std::uint32_t to : legal.neighbours[from]) {
        const double way_m = length_m[from] + (legal.p_world_m[to] - legal.p_world_m[from]).norm();
        if (way_m >= length_m[to]) continue;
        length_m[to] = way_m;
        has_changed = true;
      }
    }
  }
  return length_m;
}

/// To the last bit, also from a start between the lattice's positions, whose legs are short.
TEST(LatticeWays, AreAsShortAsTheShortestOverAllLegs) {
  const World world{wall_with_door(1.4), true};
  const RayScene scene(world);
  const LegalViewpoints legal =
      find_legal_viewpoints(scene, kRoom, kRadius_m, 0.4, Vec3(-2.01, -3.02, 2.01), 2);
  const LatticeWays ways(scene, legal, kRadius_m);
  std::vector<std::size_t> places(legal.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  const std::vector<float> row_m = ways.distances_m(ways.start(), places, 2);
  const std::vector<double> length_m = relaxed_lengths_m(legal);
  std::size_t behind = 0;
  for (std::size_t place = 0; place < legal.size(); ++place) {
    const double straight_m = (legal.p_world_m[place] - legal.start_world_m).norm();
    if (is_leg_clear(scene, legal.start_world_m, legal.p_world_m[place], kRadius_m)) continue;
    ++behind;
    EXPECT_EQ(row_m[place], static_cast<float>(std::max(length_m[place], straight_m)));
  }
  EXPECT_GT(behind, 100U);
}

}  // namespace
}  // namespace gnbv
