// The way around an obstacle: clear, free, no longer than it has to be.
#include <gtest/gtest.h>

#include <stdexcept>

#include "planner/motion/free_space.hpp"
#include "planner/motion/paths.hpp"
#include "tests/planner/map/drawn_map.hpp"

namespace gnbv {
namespace {

const Box3 kWorkspace(Vec3(-6, -6, 0), Vec3(6, 6, 6));
constexpr double kRadius_m = 0.6;

/// Free space with a wall at x = 0 from y = -6 up to `end_y_m`, full height.
OccupancyGrid wall_up_to(double end_y_m, bool is_rest_free = true) {
  OccupancyGrid grid(OccupancyConfig{}, kWorkspace);
  const auto is_wall = [&](const Vec3& p_m) {
    return std::abs(p_m.x()) < 0.2 && p_m.y() < end_y_m;
  };
  if (is_rest_free) clear(grid, voxels_where(grid, everywhere));
  hit(grid, voxels_where(grid, is_wall));
  return grid;
}

const Vec3 kFrom(-3, 0, 3);
const Vec3 kTo(3, 0, 3);
const NoFly kNoBoxes;

FoundPath search(const OccupancyGrid& grid, const PathSearchConfig& config = {},
                 const Box3& navigation_m = kWorkspace, bool allow_unknown = false) {
  return find_path(config, {grid, navigation_m, kNoBoxes, kRadius_m, allow_unknown}, kFrom, kTo);
}

TEST(FindPath, GoesAroundAWallAndStaysClear) {
  const OccupancyGrid grid = wall_up_to(2.0);
  ASSERT_FALSE(is_path_clear(grid, kFrom, kTo, kRadius_m));
  const FoundPath found = search(grid);
  ASSERT_FALSE(found.rejected);
  const std::vector<Vec3>& via_m = found.via_world_m;
  ASSERT_FALSE(via_m.empty());
  Vec3 at_m = kFrom;
  for (std::size_t i = 0; i <= via_m.size(); ++i) {
    const Vec3 next_m = i < via_m.size() ? via_m[i] : kTo;
    EXPECT_TRUE(is_path_clear(grid, at_m, next_m, kRadius_m));
    EXPECT_TRUE(is_line_free(grid, at_m, next_m));
    EXPECT_TRUE(kWorkspace.contains(next_m));
    at_m = next_m;
  }
  // the shortest way round: a taut string over the wall's end, its corners at the radius
  const Vec3 corner(0.0, 2.0 + kRadius_m, 3.0);
  const double taut_m = (corner - kFrom).norm() + (kTo - corner).norm();
  const double length_m = path_length_m(kFrom, via_m, kTo);
  EXPECT_GE(length_m, taut_m - 0.3);  // the corner is round
  EXPECT_LE(length_m, 1.25 * taut_m);
}

TEST(FindPath, FromAMillimetreBelowTheBoxIsAsShort) {
  const OccupancyGrid grid = wall_up_to(2.0);
  Box3 above_m = kWorkspace;
  above_m.min().z() = kFrom.z() + 0.001;
  above_m.max().z() = above_m.min().z() + 0.1;  // one level of the lattice
  const Vec3 to_m = kTo + Vec3(0, 0, 0.001);
  const FoundPath found = find_path({}, {grid, above_m, kNoBoxes, kRadius_m}, kFrom, to_m);
  ASSERT_FALSE(found.rejected);
  EXPECT_NEAR(path_length_m(kFrom, found.via_world_m, to_m),
              path_length_m(kFrom, search(grid).via_world_m, kTo), 0.1);
}

TEST(FindPath, SaysWhyThereIsNoWay) {
  const PathSearchConfig all = {.max_expansions = 10000};  // that the box has
  const Box3 short_of_the_gap_m(Vec3(-6, -6, 0), Vec3(6, 1.5, 6));
  EXPECT_EQ(search(wall_up_to(-7.0)).rejected, std::nullopt);
  EXPECT_TRUE(search(wall_up_to(-7.0)).via_world_m.empty()) << "straight";
  EXPECT_EQ(search(wall_up_to(7.0), all).rejected, Rejection::path_blocked);
  EXPECT_EQ(search(wall_up_to(2.0, false), all).rejected, Rejection::path_blocked) << "unknown";
  EXPECT_EQ(search(wall_up_to(2.0), {}, short_of_the_gap_m).rejected, Rejection::path_blocked);
  EXPECT_EQ(search(wall_up_to(2.0), {.max_expansions = 5}).rejected, Rejection::search_limit);
}

TEST(FindPath, CrossesUnknownSpaceWhereThatIsAllowed) {
  const OccupancyGrid grid = wall_up_to(2.0, false);
  const FoundPath found = search(grid, {}, kWorkspace, true);
  ASSERT_FALSE(found.rejected);
  ASSERT_FALSE(found.via_world_m.empty());
  EXPECT_TRUE(is_path_clear(grid, kFrom, found.via_world_m.front(), kRadius_m));
}

/// On the near side of a wall with an opening at its far end there are 44,000 nodes to look at.
TEST(FindPath, InALargerBoxItLooksAtMore) {
  constexpr double kLong_m = 40.0;
  const Box3 hall_m(Vec3(-kLong_m, -kLong_m, 0), Vec3(kLong_m, kLong_m, 3));
  OccupancyGrid grid({.resolution_m = 0.5}, hall_m);
  clear(grid, voxels_where(grid, everywhere));
  fill(grid, Box3(Vec3(-0.5, -kLong_m, 0), Vec3(0.5, 35.0, 3)));
  const FreeSpace space{grid, hall_m, kNoBoxes, kRadius_m, false};
  const auto rejected = [&](int max_expansions) {
    return find_path({max_expansions}, space, Vec3(-3, -35, 1.5), Vec3(3, -35, 1.5)).rejected;
  };
  EXPECT_EQ(rejected(10000), Rejection::search_limit);
  EXPECT_EQ(rejected(24000), std::nullopt);  // fewer than there are: in this box it stands for more
}

/// No camera sees the voxels that the vehicle is in.
TEST(FindPath, BeginsInVoxelsThatNobodyHasSeen) {
  OccupancyGrid grid(OccupancyConfig{}, kWorkspace);
  clear(grid, voxels_where(grid, [](const Vec3& p_m) { return (p_m - kFrom).norm() > 0.5; }));
  EXPECT_FALSE(search(grid).rejected);
  EXPECT_TRUE(is_line_free(grid, kFrom, kTo, kRadius_m));
  EXPECT_FALSE(is_line_free(grid, kFrom, kTo, 0.3)) << "more than the vehicle is large";
  EXPECT_FALSE(is_line_free(grid, kTo, kFrom, kRadius_m)) << "for a vehicle that is elsewhere";
  const Vec3 beyond_m = kFrom - Vec3(2, 0, 0);
  EXPECT_FALSE(is_line_free(grid, beyond_m, kTo, 10.0)) << "it was seen where it is";
}

TEST(FindPath, AsksAtEachNodeWhetherToStop) {
  const OccupancyGrid grid = wall_up_to(7.0);
  int asked = 0;
  const auto stop = [&] {
    if (++asked == 100) throw std::runtime_error("stop");
  };
  const FreeSpace space{grid, kWorkspace, kNoBoxes, kRadius_m, false};
  EXPECT_THROW(find_path({}, space, kFrom, kTo, stop), std::runtime_error);
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
