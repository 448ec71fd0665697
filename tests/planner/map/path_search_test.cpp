// The way around an obstacle: clear, free, no longer than it has to be.
#include "planner/map/path_search.hpp"

#include <gtest/gtest.h>

#include "planner/map/clearance.hpp"

namespace gnbv {
namespace {

const Box3 kWorkspace(Vec3(-6, -6, 0), Vec3(6, 6, 6));
constexpr double kRadius_m = 0.6;

/// Free space with a wall at x = 0 from y = -6 up to `end_y_m`, full height.
OccupancyGrid wall_up_to(double end_y_m, bool is_rest_free = true) {
  OccupancyGrid grid(OccupancyConfig{}, kWorkspace);
  ScanUpdate update;
  const auto voxels = static_cast<VoxelIndex>(grid.geometry().voxel_count());
  for (VoxelIndex v = 0; v < voxels; ++v) {
    const Vec3 p_m = grid.geometry().center_m(grid.geometry().key_at(v));
    if (std::abs(p_m.x()) < 0.2 && p_m.y() < end_y_m) {
      update.occupied.push_back(v);
    } else if (is_rest_free) {
      update.free.push_back(v);
    }
  }
  grid.apply(update);
  return grid;
}

const Vec3 kFrom(-3, 0, 3);
const Vec3 kTo(3, 0, 3);

TEST(FindPath, GoesAroundAWallAndStaysClear) {
  const OccupancyGrid grid = wall_up_to(2.0);
  ASSERT_FALSE(is_path_clear(grid, kFrom, kTo, kRadius_m));
  const auto via = find_path({}, grid, kWorkspace, kFrom, kTo, kRadius_m);
  ASSERT_TRUE(via);
  ASSERT_FALSE(via->empty());
  Vec3 at_m = kFrom;
  for (std::size_t i = 0; i <= via->size(); ++i) {
    const Vec3 next_m = i < via->size() ? (*via)[i] : kTo;
    EXPECT_TRUE(is_path_clear(grid, at_m, next_m, kRadius_m));
    EXPECT_TRUE(is_line_free(grid, at_m, next_m));
    EXPECT_TRUE(kWorkspace.contains(next_m));
    at_m = next_m;
  }
  // the shortest way round: a taut string over the wall's end, its corners at the radius
  const Vec3 corner(0.0, 2.0 + kRadius_m, 3.0);
  const double taut_m = (corner - kFrom).norm() + (kTo - corner).norm();
  const double length_m = path_length_m(kFrom, *via, kTo);
  EXPECT_GE(length_m, taut_m - 0.3);  // the corner is round
  EXPECT_LE(length_m, 1.25 * taut_m);
}

TEST(FindPath, IsStraightWhereNothingIsInTheWay) {
  const OccupancyGrid grid = wall_up_to(-7.0);
  const auto via = find_path({}, grid, kWorkspace, kFrom, kTo, kRadius_m);
  ASSERT_TRUE(via);
  EXPECT_TRUE(via->empty());
}

TEST(FindPath, FindsNothingThroughAClosedWallOrUnknownSpace) {
  EXPECT_FALSE(find_path({}, wall_up_to(7.0), kWorkspace, kFrom, kTo, kRadius_m));
  EXPECT_FALSE(find_path({}, wall_up_to(2.0, false), kWorkspace, kFrom, kTo, kRadius_m));
}

TEST(FindPath, CrossesUnknownSpaceWhereThatIsAllowed) {
  const OccupancyGrid grid = wall_up_to(2.0, false);
  const auto via = find_path({}, grid, kWorkspace, kFrom, kTo, kRadius_m, {}, true);
  ASSERT_TRUE(via);
  EXPECT_FALSE(via->empty());
  EXPECT_TRUE(is_path_clear(grid, kFrom, via->front(), kRadius_m));
}

TEST(FindPath, GivesUpWhenItsWorkIsSpent) {
  PathSearchConfig few;
  few.max_expansions = 5;
  EXPECT_FALSE(find_path(few, wall_up_to(2.0), kWorkspace, kFrom, kTo, kRadius_m));
}

TEST(FindPath, StaysInTheNavigationBox) {
  // the only opening, beyond y = 2, lies outside the box
  const Box3 navigation(Vec3(-6, -6, 0), Vec3(6, 1.5, 6));
  EXPECT_FALSE(find_path({}, wall_up_to(2.0), navigation, kFrom, kTo, kRadius_m));
}

TEST(PathLength, IsTheSumOfItsLegs) {
  EXPECT_EQ(path_length_m(Vec3(0, 0, 0), {}, Vec3(3, 4, 0)), 5.0);
  const std::vector<Vec3> via = {Vec3(3, 0, 0)};
  EXPECT_EQ(path_length_m(Vec3(0, 0, 0), via, Vec3(3, 4, 0)), 7.0);
}

TEST(LineFree, AsksEveryVoxelOfTheLine) {
  const OccupancyGrid grid = wall_up_to(2.0);
  EXPECT_FALSE(is_line_free(grid, kFrom, kTo));
  EXPECT_TRUE(is_line_free(grid, kFrom, Vec3(-1, 0, 3)));
  EXPECT_TRUE(is_line_free(grid, Vec3(-6, 3, 3), Vec3(6, 3, 6)));  // on the workspace's faces
  EXPECT_FALSE(is_line_free(wall_up_to(2.0, false), kFrom, Vec3(-1, 0, 3)));
}

}  // namespace
}  // namespace gnbv
