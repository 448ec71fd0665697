#include "planner/motion/roadmap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "sim/core/rng.hpp"
#include "tests/planner/map/drawn_map.hpp"

namespace gnbv {
namespace {

const Box3 kBox(Vec3(-6, -6, 0), Vec3(6, 6, 4));
const NoFly kNoBoxes;
constexpr double kRadius_m = 0.5;

struct World {
  explicit World(OccupancyGrid occupancy)
      : grid(std::move(occupancy)),
        space(grid.geometry(), kBox, {}, kRadius_m),
        roadmap(grid.geometry(), kBox, 1.0) {
    space.follow(grid);
    follow(Vec3(-5, -5, 1));
  }
  FreeSpace free_space() const {
    return {.grid = grid,
            .navigation_m = kBox,
            .no_fly = kNoBoxes,
            .radius_m = kRadius_m,
            .leg_keeps_start_room = true};
  }
  void follow(const Vec3& here_m, const HeedStop& stop = {}) {
    roadmap.follow(free_space(), space, here_m, stop);
  }
  OccupancyGrid grid;
  OpenSpace space;
  Roadmap roadmap;
};

bool is_reachable(const Roadmap& roadmap, Roadmap::Node node) {
  const std::span<const Roadmap::Node> nodes = roadmap.reachable();
  return std::binary_search(nodes.begin(), nodes.end(), node);
}

/// The length of a row's way, which is that of its legs, each along an open line.
double checked_length_m(World& world, Roadmap::Node from, const Vec3& from_m, Roadmap::Node to) {
  std::vector<Vec3> way_m = world.roadmap.via_world_m(from, to);
  way_m.push_back(world.roadmap.p_world_m(to));
  double sum_m = 0.0;
  Vec3 at_m = from_m;
  for (const Vec3& p_m : way_m) {
    EXPECT_TRUE(world.space.is_line_open(world.grid, at_m, p_m) ||
                world.space.is_line_open(world.grid, p_m, at_m));
    sum_m += (p_m - at_m).norm();
    at_m = p_m;
  }
  EXPECT_NEAR(sum_m, static_cast<double>(world.roadmap.row_m(from)[to]), 1e-3);
  return sum_m;
}

TEST(Roadmap, InEmptySpaceWaysAreNearlyStraight) {
  World world(free_grid(kBox));
  EXPECT_GT(world.roadmap.size(), 13U * 13U * 4U);
  for (Roadmap::Node from = 0; from < world.roadmap.size(); from += 37) {
    const std::span<const float> row_m = world.roadmap.row_m(from);
    for (Roadmap::Node to = 1; to < world.roadmap.size(); ++to) {
      const double straight_m =
          (world.roadmap.p_world_m(from) - world.roadmap.p_world_m(to)).norm();
      ASSERT_GE(row_m[to], straight_m - 1e-4);
      ASSERT_LE(row_m[to], 1.1 * straight_m + 1e-4);
    }
  }
}

TEST(Roadmap, AWallIsGoneAroundAndItsLegsAreOpen) {
  // leaves a gap at large x
  World world(free_grid(kBox, Box3(Vec3(-6, -0.2, 0), Vec3(4, 0.2, 4))));
  const auto behind = world.roadmap.add(Vec3(-5, 5, 1));
  world.follow(Vec3(-5, -5, 1));
  ASSERT_TRUE(is_reachable(world.roadmap, behind));
  const double length_m = checked_length_m(world, Roadmap::here(), Vec3(-5, -5, 1), behind);
  const double least_m = 2.0 * std::hypot(9.0, 5.0);  // by the wall's end
  EXPECT_GT(length_m, least_m);
  EXPECT_LT(length_m, 1.15 * least_m);
}

TEST(Roadmap, BehindAClosedWallNothingIsReached) {
  World world(free_grid(kBox, Box3(Vec3(-6, -0.2, 0), Vec3(6, 0.2, 4))));
  for (Roadmap::Node place = 1; place < world.roadmap.size(); ++place) {
    const bool is_on_this_side = world.roadmap.p_world_m(place).y() < -0.7;
    const bool is_other_side = world.roadmap.p_world_m(place).y() > 0.0;
    if (is_on_this_side) {
      EXPECT_TRUE(is_reachable(world.roadmap, place));
    }
    if (is_other_side) {
      EXPECT_FALSE(is_reachable(world.roadmap, place));
      EXPECT_TRUE(std::isinf(world.roadmap.row_m(Roadmap::here())[place]));
    }
  }
}

TEST(Roadmap, AWayThatIsKeptLearnsOfPlacesThatOpen) {
  const Box3 block_m(Vec3(2, 2, 0), Vec3(6, 6, 4));
  World world(free_grid(kBox, block_m));
  const Roadmap::Node from = 1;
  Roadmap::Node within = 1;
  while (!(world.roadmap.p_world_m(within) - Vec3(4, 4, 2)).isZero(0.6)) ++within;
  ASSERT_TRUE(std::isinf(world.roadmap.row_m(from)[within]));
  world.grid = free_grid(kBox);
  world.space.follow(world.grid);
  world.follow(Vec3(-5, -5, 1));
  const double straight_m =
      (world.roadmap.p_world_m(from) - world.roadmap.p_world_m(within)).norm();
  const double length_m = checked_length_m(world, from, world.roadmap.p_world_m(from), within);
  EXPECT_GE(length_m, straight_m - 1e-4);
  EXPECT_LE(length_m, 1.3 * straight_m);
}

TEST(Roadmap, AWayThatIsAskedForLaterKnowsTheMapOfThen) {
  World asked(free_grid(kBox));
  World fresh(free_grid(kBox));
  const Roadmap::Node from = 1;
  const std::span<const float> before_m = asked.roadmap.row_m(from);
  const std::vector<float> free_m(before_m.begin(), before_m.end());
  for (World* world : {&asked, &fresh}) {
    fill(world->grid, Box3(Vec3(-1, -4, 0), Vec3(1, 4, 4)));
    world->roadmap.forget_ways();
  }
  const std::span<const float> asked_m = asked.roadmap.row_m(from);
  const std::span<const float> fresh_m = fresh.roadmap.row_m(from);
  EXPECT_TRUE(std::ranges::equal(asked_m, fresh_m));
  EXPECT_FALSE(std::ranges::equal(asked_m, free_m));
}

TEST(Roadmap, LeadsFromAVoxelThatNobodyHasSeen) {
  OccupancyGrid grid(OccupancyConfig{}, kBox);
  const Vec3 here_m(-4.9, -4.9, 1.1);
  clear(grid, voxels_where(grid, [&](const Vec3& p_m) { return (p_m - here_m).norm() > 0.1; }));
  World world(std::move(grid));
  world.follow(here_m);
  EXPECT_TRUE(is_reachable(world.roadmap, 1));
}

/// Under a wing that it saw late, the vehicle is nearer to all of it than its radius: wherever it
/// goes, it comes as near to some of it.
TEST(Roadmap, LeadsOutFromUnderAWing) {
  World world(free_grid(kBox, Box3(Vec3(-3, -3, 1.4), Vec3(3, 3, 2))));
  const Vec3 here_m(0.13, -0.21, 0.97);
  ASSERT_FALSE(is_sphere_clear(world.grid, here_m, kRadius_m));
  world.follow(here_m);
  const auto beside = world.roadmap.nearest(Vec3(-5, -5, 3));
  ASSERT_TRUE(is_reachable(world.roadmap, beside));
  for (const Roadmap::Node node : world.roadmap.reachable()) {
    std::vector<Vec3> way_m = world.roadmap.via_world_m(Roadmap::here(), node);
    way_m.push_back(world.roadmap.p_world_m(node));
    ASSERT_TRUE(world.free_space().is_leg_free(here_m, way_m.front())) << node;
  }
}

/// All open nodes lie on the other side of an edge of the cubes that nodes are sorted into, which
/// is at 1.01 * sqrt(3) m.
TEST(Roadmap, ANodeBesideTheLatticeIsLinkedToAllAboutIt) {
  for (int axis = 0; axis < 2; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      Box3 wall_m = kBox;
      (side > 0.0 ? wall_m.max() : wall_m.min())[axis] = 0.7 * side;
      World world(free_grid(kBox, wall_m));
      Vec3 p_world_m(0.0, 0.0, 2.0);
      p_world_m[axis] = 1.6 * side;
      const Roadmap::Node added = world.roadmap.add(p_world_m);
      Vec3 here_m(0.0, 0.0, 1.0);
      here_m[axis] = 5.0 * side;
      world.follow(here_m);
      EXPECT_TRUE(is_reachable(world.roadmap, added)) << axis << " " << side;
    }
  }
}

/// Wherever it was stopped, it goes on as if it had not been.
TEST(Roadmap, AsksOftenWhetherToStopAndKeepsNothingHalfDone) {
  World world(free_grid(kBox));
  const Vec3 here_m(-5, -5, 1);
  const std::vector<float> whole_m(world.roadmap.row_m(5).begin(), world.roadmap.row_m(5).end());
  int asked = 0;
  int stop_at = 1 << 30;
  const HeedStop stop = [&] {
    if (++asked >= stop_at) throw std::runtime_error("stop");
  };
  const auto plan = [&] {
    asked = 0;
    world.roadmap.forget_ways();
    world.follow(here_m, stop);
    world.roadmap.row_m(5, stop);
  };
  plan();
  const int all = asked;
  EXPECT_GT(all, 2 * static_cast<int>(world.roadmap.size()));
  for (const int at : {1, all / 4, all / 2, 3 * all / 4, all - 1}) {
    stop_at = at;
    EXPECT_THROW(plan(), std::runtime_error);
    world.follow(here_m);
    const std::span<const float> row_m = world.roadmap.row_m(5);
    EXPECT_TRUE(std::equal(row_m.begin(), row_m.end(), whole_m.begin(), whole_m.end())) << at;
  }
}

TEST(Roadmap, TheNearestNodeOfTheLatticeIsThatOfBruteForce) {
  World world(free_grid(kBox));
  Rng rng(1, Stream::bench, 0);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 p_m =
        kBox.min() + Vec3(rng.uniform(), rng.uniform(), rng.uniform()).cwiseProduct(kBox.sizes());
    double least_m = std::numeric_limits<double>::infinity();
    for (Roadmap::Node node = 1; node < world.roadmap.size(); ++node) {
      least_m = std::min(least_m, (world.roadmap.p_world_m(node) - p_m).norm());
    }
    const Roadmap::Node nearest = world.roadmap.nearest(p_m);
    EXPECT_NEAR((world.roadmap.p_world_m(nearest) - p_m).norm(), least_m, 1e-9);
  }
}

}  // namespace
}  // namespace gnbv
