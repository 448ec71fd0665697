// View validity against brute force and hand-drawn scenes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "planner/motion/config.hpp"
#include "planner/motion/paths.hpp"
#include "sim/core/rng.hpp"
#include "tests/planner/map/drawn_map.hpp"

namespace gnbv {
namespace {

const Box3 kWorkspace(Vec3(-5, -5, 0), Vec3(5, 5, 5));
const NoFly kNoBoxes;
const Box3 kNavigation(Vec3(-5, -5, 0.7), Vec3(5, 5, 5));

double draw(std::uint64_t frame, std::uint64_t index) {
  return uniform01({11, Stream::bench, frame, index});
}

OccupancyGrid empty_grid() { return OccupancyGrid(OccupancyConfig{}, kWorkspace); }

/// Everything measured free but for the voxels at these points.
OccupancyGrid free_but_at(const std::vector<Vec3>& points_m) {
  OccupancyGrid grid = free_grid(kWorkspace);
  for (const Vec3& p_m : points_m) hit(grid, {voxel_at(grid, p_m)});
  return grid;
}

TEST(PathCheck, EqualsBruteForceOverSampledSpheres) {
  OccupancyGrid grid = free_grid(kWorkspace);
  std::set<VoxelIndex> occupied;
  for (std::uint64_t i = 0; i < 60; ++i) {
    occupied.insert(
        static_cast<VoxelIndex>(draw(0, i) * static_cast<double>(grid.geometry().voxel_count())));
  }
  hit(grid, {occupied.begin(), occupied.end()});
  constexpr double kRadius_m = 0.8;
  int blocked = 0;
  int compared = 0;
  for (std::uint64_t trial = 0; trial < 300; ++trial) {
    const auto point = [&](std::uint64_t at) {
      return Vec3(draw(at, 3 * trial) * 10 - 5, draw(at, 3 * trial + 1) * 10 - 5,
                  draw(at, 3 * trial + 2) * 5);
    };
    const Vec3 a = point(1);
    const Vec3 b = point(2);
    if (!is_sphere_clear(grid, a, kRadius_m)) continue;
    double nearest_m = 1e9;
    for (int i = 0; i <= 400; ++i) {
      const Vec3 p = a + (i / 400.0) * (b - a);
      for (const VoxelIndex v : occupied) {
        const Vec3 c = grid.geometry().center_m(grid.geometry().key_at(v));
        const Box3 cube(c - Vec3::Constant(0.1), c + Vec3::Constant(0.1));
        nearest_m = std::min(nearest_m, cube.exteriorDistance(p));
      }
    }
    // 400 samples of a segment under 15 m miss the nearest point by less than 1 cm
    if (std::fabs(nearest_m - kRadius_m) < 0.01) continue;
    ++compared;
    blocked += nearest_m < kRadius_m ? 1 : 0;
    EXPECT_EQ(is_path_clear(grid, a, b, kRadius_m), nearest_m > kRadius_m) << trial;
  }
  EXPECT_GT(compared, 200);
  EXPECT_GT(blocked, 50);  // the scene says both yes and no
  EXPECT_LT(blocked, compared - 20);
}

/// The same question of every voxel within the radius of the segment's box, without a shortcut.
bool is_clear_of_each(const OccupancyGrid& grid, const std::set<VoxelIndex>& occupied,
                      const Vec3& a_m, const Vec3& b_m, double radius_m) {
  const GridGeometry& geometry = grid.geometry();
  const Vec3 half_m = Vec3::Constant(0.5 * geometry.resolution_m());
  return std::none_of(occupied.begin(), occupied.end(), [&](VoxelIndex v) {
    const Key key = geometry.key_at(v);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto axis = static_cast<Eigen::Index>(i);
      const auto [low_m, high_m] = std::minmax(a_m[axis], b_m[axis]);
      if (key[i] < geometry.key_of(low_m - radius_m)) return false;
      if (key[i] > geometry.key_of(high_m + radius_m)) return false;
    }
    const Box3 cube(geometry.center_m(key) - half_m, geometry.center_m(key) + half_m);
    const double nearest_m2 = box_to_segment_m2(cube, a_m, b_m);
    return nearest_m2 < radius_m * radius_m &&
           nearest_m2 < cube.squaredExteriorDistance(a_m) - 1e-9;
  });
}

TEST(PathCheck, EqualsAskingEachVoxelOnTheLatticeToo) {
  const OccupancyGrid probe = empty_grid();
  int blocked = 0;
  for (std::uint64_t trial = 0; trial < 3000; ++trial) {
    std::uint64_t drawn = 0;
    const auto next = [&] { return draw(10 + trial, drawn++); };
    const double half_voxels = next() < 0.5 ? 1.0 : 2.0;  // centres and borders, or centres alone
    const auto point = [&] {
      Vec3 p_m(next() * 14 - 7, next() * 14 - 7, next() * 9 - 2);  // some outside
      if (trial % 4 == 0) return p_m;
      for (Eigen::Index a = 0; a < 3; ++a) {
        p_m[a] = 0.1 * (half_voxels * std::floor(p_m[a] / (0.1 * half_voxels)) + 1.0);
      }
      return p_m;
    };
    const Vec3 a_m = point();
    Vec3 b_m = point();
    for (Eigen::Index a = 0; a < 3; ++a) {
      if (next() < 0.4) b_m[a] = a_m[a];  // along an axis or a plane, or not at all
    }
    std::set<VoxelIndex> occupied;
    for (int i = 0; i < 3; ++i) {
      const Vec3 near_m =
          a_m + next() * (b_m - a_m) + Vec3(next() * 4 - 2, next() * 4 - 2, next() * 4 - 2);
      const Key key = probe.geometry().key_of(near_m);
      if (probe.geometry().contains(key)) occupied.insert(probe.geometry().index_of(key));
    }
    OccupancyGrid grid = empty_grid();
    grid.apply({.free = {}, .occupied = {occupied.begin(), occupied.end()}});
    for (const double radius_m : {0.5, 0.8, 1.5}) {
      const bool is_clear = is_clear_of_each(grid, occupied, a_m, b_m, radius_m);
      blocked += is_clear ? 0 : 1;
      ASSERT_EQ(is_path_clear(grid, a_m, b_m, radius_m), is_clear)
          << trial << ": " << a_m.transpose() << " to " << b_m.transpose() << ", " << radius_m;
    }
  }
  EXPECT_GT(blocked, 1000);
}

TEST(PathCheck, WhatIsTooCloseAlreadyMayBeLeftButNotApproached) {
  const OccupancyGrid grid = free_but_at({Vec3(0.1, 0.1, 2.1)});
  const Vec3 here(0.1, 1.0, 2.1);  // 0.8 m from the voxel's face
  EXPECT_FALSE(is_sphere_clear(grid, here, 1.5));
  EXPECT_TRUE(is_path_clear(grid, here, here + Vec3(0, 1, 0), 1.5));
  EXPECT_TRUE(is_path_clear(grid, here, here + Vec3(1, 0.5, 0), 1.5));
  EXPECT_FALSE(is_path_clear(grid, here, here - Vec3(0, 0.1, 0), 1.5));
  EXPECT_FALSE(is_path_clear(grid, here, here + Vec3(2, -0.5, 0), 1.5));
}

/// Under a plate that it saw late: as near as it is, but not nearer, and half the radius at least.
TEST(FreeSpaceLeg, KeepsTheRoomThatItsStartHas) {
  std::vector<Vec3> plate_m;
  for (double x_m = -3.9; x_m < 4.0; x_m += 0.2) {
    for (double y_m = -3.9; y_m < 4.0; y_m += 0.2) plate_m.emplace_back(x_m, y_m, 2.1);
  }
  const OccupancyGrid grid = free_but_at(plate_m);
  FreeSpace space{.grid = grid,
                  .navigation_m = kNavigation,
                  .no_fly = kNoBoxes,
                  .radius_m = 1.5,
                  .leg_keeps_start_room = true};
  const auto leg = [&](double room_m, double end_room_m) {
    return space.is_leg_clear(Vec3(0, 0, 2.0 - room_m), Vec3(3, 0, 2.0 - end_room_m));
  };
  EXPECT_TRUE(leg(1.2, 1.2));
  EXPECT_TRUE(leg(1.2, 1.16)) << "the vehicle flies beside the places planned";
  EXPECT_FALSE(leg(1.2, 1.1));
  EXPECT_TRUE(leg(0.8, 0.8));
  EXPECT_FALSE(leg(0.7, 0.7)) << "less than half the radius";
  EXPECT_FALSE(leg(1.6, 1.4)) << "from where it has its room";
  space.leg_keeps_start_room = false;
  EXPECT_FALSE(leg(1.2, 1.2)) << "the paper's rule";
}

std::optional<Rejection> rejection(const ValidityConfig& config, const OccupancyGrid& grid,
                                   std::span<const ViewPose> recent, const ViewPose& current,
                                   const ViewPose& view) {
  return ViewChecker(config, kNavigation, kNoBoxes, grid, recent, current).check(view).rejected;
}

TEST(ViewValidity, NamesTheReason) {
  const OccupancyGrid grid = free_but_at({Vec3(0.1, 0.1, 2.1)});
  const ValidityConfig config{.collision_radius_m = 0.5};
  const ViewPose current{Vec3(-2, 0.1, 2.1), 0};
  const std::vector<ViewPose> recent = {{Vec3(-2, 2, 2), 1.0}};
  const auto reason = [&](const ViewPose& candidate) {
    return rejection(config, grid, recent, current, candidate);
  };
  EXPECT_EQ(reason({Vec3(-2, 1, 2), 0}), std::nullopt);
  EXPECT_EQ(reason({Vec3(-2, 1, 0.6), 0}), Rejection::out_of_bounds);
  EXPECT_EQ(reason({Vec3(-2, 2, 2), 1.05}), Rejection::recently_visited);
  EXPECT_EQ(reason({Vec3(-2, 2, 2), 1.2}), std::nullopt);
  EXPECT_EQ(reason({Vec3(0.1, 0.1, 2.1), 0}), Rejection::not_free);
  EXPECT_EQ(reason({Vec3(0.1, 0.1, 2.6), 0}), Rejection::collision);
  EXPECT_EQ(reason({Vec3(2, 0.1, 2.1), 0}), Rejection::path_blocked);
  for (const Vec3& p : {Vec3(5, 5, 5), Vec3(-5, -5, 0.7), Vec3(5, -5, 0.7)}) {
    EXPECT_EQ(reason({p, 0}), std::nullopt) << "the box's faces are inside";
  }
  EXPECT_EQ(rejection({}, empty_grid(), {}, {Vec3(0, 0, 2), 0}, {Vec3(1, 0, 2), 0}),
            Rejection::not_free)
      << "unknown space";
}

TEST(ViewValidity, NoViewInANoFlyBoxAndNoWayThroughOne) {
  const OccupancyGrid grid = free_grid(kWorkspace);
  const NoFly no_fly{{Box3(Vec3(-0.5, -1, 0), Vec3(0.5, 1, 5))}, 0.5};
  const ViewPose current{Vec3(-3, 0, 2), 0};
  for (const PathCheck path : {PathCheck::straight, PathCheck::unchecked, PathCheck::astar}) {
    const ValidityConfig config{.collision_radius_m = 0.5, .path = path};
    const auto checked = [&](const Vec3& p_m) {
      return ViewChecker(config, kNavigation, no_fly, grid, {}, current).check({p_m, 0});
    };
    EXPECT_EQ(checked({0, 0, 2}).rejected, Rejection::no_fly);
    EXPECT_EQ(checked({-0.8, 0, 2}).rejected, Rejection::no_fly);  // nearer than the radius
    EXPECT_EQ(checked({-1.5, 0, 2}).rejected, std::nullopt);
    const FoundPath beyond = checked({3, 0, 2});
    if (path != PathCheck::astar) {
      EXPECT_EQ(beyond.rejected, Rejection::path_blocked);
      continue;
    }
    EXPECT_EQ(beyond.rejected, std::nullopt);
    Vec3 at_m = current.p_world_m;
    std::vector<Vec3> points_m = beyond.via_world_m;
    points_m.emplace_back(3, 0, 2);
    EXPECT_GE(points_m.size(), 2U);
    for (const Vec3& next_m : points_m) {
      EXPECT_TRUE(no_fly.allows_leg(at_m, next_m));
      at_m = next_m;
    }
  }
}

/// No camera sees the voxel that the vehicle is in, but it may turn there and leave.
TEST(ViewValidity, TheVehiclesOwnVoxelIsFree) {
  OccupancyGrid grid = empty_grid();
  const ViewPose current{Vec3(-2, 0.1, 2.1), 0};
  clear(grid, voxels_where(
                  grid, [&](const Vec3& p_m) { return (p_m - current.p_world_m).norm() > 0.1; }));
  for (const PathCheck path : {PathCheck::straight, PathCheck::astar}) {
    const ValidityConfig config{.collision_radius_m = 0.5, .path = path};
    EXPECT_EQ(rejection(config, grid, {}, current, {current.p_world_m, 1.0}), std::nullopt);
    EXPECT_EQ(rejection(config, grid, {}, current, {Vec3(1, 0.1, 2.1), 0}), std::nullopt);
    EXPECT_EQ(rejection(config, grid, {}, {Vec3(1, 0.1, 2.1), 0}, current), Rejection::not_free);
  }
}

TEST(ViewValidity, AWayThatIsCheckedByAStarLeadsThroughKnownSpaceWhereverItLeads) {
  // free but for a slab of unknown voxels across the whole box: nothing occupied anywhere
  OccupancyGrid grid = empty_grid();
  clear(grid, voxels_where(grid, [](const Vec3& p_m) { return std::abs(p_m.x()) > 0.3; }));
  ValidityConfig config{.collision_radius_m = 0.5, .path = PathCheck::astar};
  const auto reason = [&] {
    return rejection(config, grid, {}, {Vec3(-2, 0, 2), 0}, {Vec3(2, 0, 2), 0});
  };
  EXPECT_EQ(reason(), Rejection::path_blocked);
  config.allow_unknown = true;
  EXPECT_EQ(reason(), std::nullopt);
  config = {.collision_radius_m = 0.5};  // the paper's own check asks for what is occupied alone
  EXPECT_EQ(reason(), std::nullopt);
}

}  // namespace
}  // namespace gnbv
