#include "planner/tour/places.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/planner/tour/free_grid.hpp"

namespace gnbv {
namespace {

const Box3 kBox(Vec3(-6, -6, 0), Vec3(6, 6, 4));

struct World {
  explicit World(OccupancyGrid occupancy)
      : grid(std::move(occupancy)),
        space(grid.geometry(), kBox, {}, 0.5),
        places(grid.geometry(), kBox, 1.0) {
    space.follow(grid);
    places.follow(grid, space, Vec3(-5, -5, 1));
  }
  OccupancyGrid grid;
  OpenSpace space;
  TourPlaces places;
};

TEST(TourPlaces, InEmptySpaceWaysAreNearlyStraight) {
  World world(free_grid(kBox));
  EXPECT_GT(world.places.size(), 13U * 13U * 4U);
  for (TourPlaces::Place from = 0; from < world.places.size(); from += 37) {
    const std::span<const float> row_m = world.places.row_m(from);
    for (TourPlaces::Place to = 1; to < world.places.size(); ++to) {
      const double straight_m = (world.places.p_world_m(from) - world.places.p_world_m(to)).norm();
      ASSERT_GE(row_m[to], straight_m - 1e-4);
      ASSERT_LE(row_m[to], 1.1 * straight_m + 1e-4);
    }
  }
}

TEST(TourPlaces, AWallIsGoneAroundAndItsLegsAreOpen) {
  OccupancyGrid grid = free_grid(kBox);
  fill(grid, Box3(Vec3(-6, -0.2, 0), Vec3(4, 0.2, 4)));  // leaves a gap at large x
  World world(std::move(grid));
  const auto behind = world.places.add(Vec3(-5, 5, 1));
  world.places.follow(world.grid, world.space, Vec3(-5, -5, 1));
  ASSERT_TRUE(world.places.is_reachable(behind));
  const float length_m = world.places.row_m(TourPlaces::here())[behind];
  const double least_m = 2.0 * std::hypot(9.0, 5.0);  // by the wall's end
  EXPECT_GT(length_m, least_m);
  EXPECT_LT(length_m, 1.15 * least_m);
  std::vector<Vec3> way_m = world.places.via_world_m(TourPlaces::here(), behind);
  way_m.insert(way_m.begin(), Vec3(-5, -5, 1));
  way_m.push_back(world.places.p_world_m(behind));
  double sum_m = 0.0;
  for (std::size_t i = 1; i < way_m.size(); ++i) {
    EXPECT_TRUE(world.space.is_line_open(world.grid, way_m[i - 1], way_m[i]) ||
                world.space.is_line_open(world.grid, way_m[i], way_m[i - 1]));
    sum_m += (way_m[i] - way_m[i - 1]).norm();
  }
  EXPECT_NEAR(sum_m, static_cast<double>(length_m), 1e-3);
}

TEST(TourPlaces, BehindAClosedWallNothingIsReached) {
  OccupancyGrid grid = free_grid(kBox);
  fill(grid, Box3(Vec3(-6, -0.2, 0), Vec3(6, 0.2, 4)));
  World world(std::move(grid));
  for (TourPlaces::Place place = 1; place < world.places.size(); ++place) {
    const bool is_on_this_side = world.places.p_world_m(place).y() < -0.7;
    const bool is_other_side = world.places.p_world_m(place).y() > 0.0;
    if (is_on_this_side) {
      EXPECT_TRUE(world.places.is_reachable(place));
    }
    if (is_other_side) {
      EXPECT_FALSE(world.places.is_reachable(place));
      EXPECT_TRUE(std::isinf(world.places.row_m(TourPlaces::here())[place]));
    }
  }
}

TEST(TourPlaces, AWayThatIsKeptLearnsOfPlacesThatOpen) {
  OccupancyGrid grid = free_grid(kBox);
  const Box3 block_m(Vec3(2, 2, 0), Vec3(6, 6, 4));
  fill(grid, block_m);
  World world(std::move(grid));
  const TourPlaces::Place from = 1;
  TourPlaces::Place within = 1;
  while (!(world.places.p_world_m(within) - Vec3(4, 4, 2)).isZero(0.6)) ++within;
  ASSERT_TRUE(std::isinf(world.places.row_m(from)[within]));
  world.grid = free_grid(kBox);
  world.space.follow(world.grid);
  world.places.follow(world.grid, world.space, Vec3(-5, -5, 1));
  const double straight_m = (world.places.p_world_m(from) - world.places.p_world_m(within)).norm();
  const float length_m = world.places.row_m(from)[within];
  EXPECT_GE(length_m, straight_m - 1e-4);
  EXPECT_LE(length_m, 1.3 * straight_m);
  double sum_m = 0.0;
  Vec3 at_m = world.places.p_world_m(from);
  for (const Vec3& p_m : world.places.via_world_m(from, within)) {
    sum_m += (p_m - at_m).norm();
    at_m = p_m;
  }
  sum_m += (world.places.p_world_m(within) - at_m).norm();
  EXPECT_NEAR(sum_m, static_cast<double>(length_m), 1e-3);
}

}  // namespace
}  // namespace gnbv
