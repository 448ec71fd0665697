#include <gtest/gtest.h>

#include "planner/motion/free_space.hpp"
#include "sim/core/rng.hpp"

namespace gnbv {
namespace {

const Box3 kBox(Vec3(-3, -3, 0), Vec3(3, 3, 3));
constexpr double kRadius_m = 0.7;

/// All free but some voxels that are occupied and some that are unknown.
OccupancyGrid scattered_grid(std::uint64_t seed) {
  OccupancyConfig config;
  config.resolution_m = 0.2;
  OccupancyGrid grid(config, kBox);
  for (VoxelIndex v = 0; v < grid.geometry().voxel_count(); ++v) {
    const double dice = uniform01({seed, Stream::bench, 0, v});
    if (dice < 0.002) {
      for (int i = 0; i < 5; ++i) grid.apply({.free = {}, .occupied = {v}});
    } else if (dice < 0.99) {
      for (int i = 0; i < 5; ++i) grid.apply({.free = {v}, .occupied = {}});
    }
  }
  return grid;
}

TEST(OpenSpace, IsWhereASphereIsClear) {
  OccupancyGrid grid = scattered_grid(1);
  OpenSpace space(grid.geometry(), kBox, {}, kRadius_m);
  for (int round = 0; round < 2; ++round) {  // the second after some of it has changed
    space.follow(grid);
    int open = 0;
    for (VoxelIndex v = 0; v < grid.geometry().voxel_count(); ++v) {
      const Key key = grid.geometry().key_at(v);
      const Vec3 center_m = grid.geometry().center_m(key);
      const auto is_clear = [&](double radius_m) {
        return grid.state(v) == VoxelState::free && is_sphere_clear(grid, center_m, radius_m);
      };
      const bool is_open = space.is_open(grid, key);
      ASSERT_LE(is_open, is_clear(kRadius_m)) << "voxel " << v;
      ASSERT_GE(is_open, is_clear(kRadius_m + 2e-6)) << "voxel " << v;
      open += is_open ? 1 : 0;
    }
    EXPECT_GT(open, 100);
    for (VoxelIndex v = 0; v < grid.geometry().voxel_count(); v += 3) {
      const bool was_occupied = grid.state(v) == VoxelState::occupied;
      for (int i = 0; i < 20 && was_occupied; ++i) grid.apply({.free = {v}, .occupied = {}});
    }
  }
}

TEST(OpenSpace, NothingBeyondTheNavigationBoxIsOpen) {
  const OccupancyGrid grid = scattered_grid(2);
  const Box3 navigation_m(Vec3(-3, -3, 1), Vec3(3, 3, 3));
  OpenSpace space(grid.geometry(), navigation_m, {}, kRadius_m);
  space.follow(grid);
  for (VoxelIndex v = 0; v < grid.geometry().voxel_count(); ++v) {
    const Key key = grid.geometry().key_at(v);
    if (grid.geometry().center_m(key).z() < 1.0) {
      EXPECT_FALSE(space.is_open(grid, key));
    }
  }
}

TEST(OpenSpace, NothingNearANoFlyBoxIsOpen) {
  OccupancyGrid grid = scattered_grid(2);
  const NoFly no_fly{.boxes_m = {Box3(Vec3(-1, -1, 0), Vec3(0, 1, 3))}, .margin_m = kRadius_m};
  OpenSpace everywhere(grid.geometry(), kBox, {}, kRadius_m);
  OpenSpace beside(grid.geometry(), kBox, no_fly, kRadius_m);
  for (int round = 0; round < 2; ++round) {  // the second without anything occupied
    everywhere.follow(grid);
    beside.follow(grid);
    int shut = 0;
    for (VoxelIndex v = 0; v < grid.geometry().voxel_count(); ++v) {
      const Key key = grid.geometry().key_at(v);
      const bool may_fly = no_fly.allows(grid.geometry().center_m(key));
      ASSERT_EQ(beside.is_open(grid, key), may_fly && everywhere.is_open(grid, key));
      if (!may_fly && everywhere.is_open(grid, key)) ++shut;
    }
    EXPECT_GT(shut, 100);
    for (VoxelIndex v = 0; v < grid.geometry().voxel_count(); ++v) {
      const bool was_occupied = grid.state(v) == VoxelState::occupied;
      for (int i = 0; i < 20 && was_occupied; ++i) grid.apply({.free = {v}, .occupied = {}});
    }
  }
}

/// A line through open voxels keeps the radius but for what lies between a voxel and its centre.
TEST(OpenSpace, AnOpenLineKeepsTheRadiusWithinHalfAVoxel) {
  const OccupancyGrid grid = scattered_grid(3);
  OpenSpace space(grid.geometry(), kBox, {}, kRadius_m);
  space.follow(grid);
  const double slack_m = 0.5 * std::sqrt(3.0) * grid.geometry().resolution_m();
  int open = 0;
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const auto at = [&](std::uint64_t k) { return uniform01({4, Stream::bench, i, k}); };
    const Vec3 a(6 * at(0) - 3, 6 * at(1) - 3, 3 * at(2));
    const Vec3 b(6 * at(3) - 3, 6 * at(4) - 3, 3 * at(5));
    if (!space.is_open(grid, grid.geometry().key_of(a)) || !space.is_line_open(grid, a, b))
      continue;
    ++open;
    EXPECT_TRUE(is_path_clear(grid, a, b, kRadius_m - slack_m));
    EXPECT_TRUE(is_line_free(grid, a, b));
  }
  EXPECT_GT(open, 20);
}

}  // namespace
}  // namespace gnbv
