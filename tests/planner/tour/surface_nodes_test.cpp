#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planner/tour/visibility_cache.hpp"
#include "tests/planner/tour/free_grid.hpp"

namespace gnbv {
namespace {

const Box3 kBox(Vec3(-8, -8, 0), Vec3(8, 8, 8));
constexpr double kRadius_m = 0.7;

struct World {
  explicit World(OccupancyGrid occupancy)
      : grid(std::move(occupancy)), space(grid.geometry(), kBox, {}, kRadius_m) {
    space.follow(grid);
  }
  std::vector<Vec3> nodes(const Patch& patch) const {
    return points_to_see({grid, space, cameras}, patch, 4);
  }
  OccupancyGrid grid;
  OpenSpace space;
  std::vector<CameraModel> cameras = {make_camera_model({})};
};

const Patch kFacingEast{
    .target_m = Vec3f(0.1F, 0.1F, 4.1F), .normal = Vec3f(1, 0, 0), .missing = 10.0F};

/// By the definition: before the patch, in a camera's image once the vehicle is turned to it.
TEST(SurfaceNodes, SeeThePatchFromBeforeItWithinTheImage) {
  OccupancyGrid grid = free_grid(kBox);
  fill(grid, Box3(Vec3(-0.2, -0.6, 3.4), Vec3(0.2, 0.6, 4.8)));
  const World world(std::move(grid));
  const std::vector<Vec3> nodes = world.nodes(kFacingEast);
  ASSERT_FALSE(nodes.empty());
  const CameraConfig& camera = world.cameras.front().config;
  for (const Vec3& p_m : nodes) {
    const Vec3 to_m = p_m - kFacingEast.target_m.cast<double>();
    EXPECT_GT(to_m.x(), 0.0);
    EXPECT_LE(std::fabs(std::atan2(to_m.z(), to_m.head<2>().norm())),
              0.5 * camera.fov_y_rad + 0.05);
    EXPECT_LE(to_m.norm(), camera.range_max_m);
    EXPECT_TRUE(world.space.is_open(world.grid, world.grid.geometry().key_of(p_m)));
  }
}

TEST(SurfaceNodes, AreNoneBehindAWallAndFewerCubesEachTime) {
  OccupancyGrid grid = free_grid(kBox);
  fill(grid, Box3(Vec3(0.8, -8, 0), Vec3(1.2, 8, 8)));  // nearer than any node may be
  const World walled(std::move(grid));
  EXPECT_TRUE(walled.nodes(kFacingEast).empty());

  const World open(free_grid(kBox));
  const std::vector<Patch> patches = {kFacingEast};
  const std::vector<std::uint8_t> unseen = {0}, seen = {1};
  SearchedCubes searched;
  const NodeSearch search{open.grid, open.space, open.cameras};
  EXPECT_TRUE(points_for_unseen(search, patches, seen, searched).empty());
  EXPECT_EQ(points_for_unseen(search, patches, unseen, searched).size(), 2U);
  EXPECT_TRUE(points_for_unseen(search, patches, unseen, searched).empty()) << "found before";
}

/// What was searched for in vain is searched for again, once space has opened.
TEST(SurfaceNodes, AreFoundWhereSpaceOpensLater) {
  OccupancyGrid grid = free_grid(kBox);
  fill(grid, Box3(Vec3(0.8, -8, 0), Vec3(1.2, 8, 8)));
  World world(std::move(grid));
  const std::vector<Patch> patches = {kFacingEast};
  const std::vector<std::uint8_t> unseen = {0};
  SearchedCubes searched;
  const auto found = [&] {
    return points_for_unseen({world.grid, world.space, world.cameras}, patches, unseen, searched);
  };
  EXPECT_TRUE(found().empty());
  world.grid = free_grid(kBox);
  world.space.follow(world.grid);
  EXPECT_EQ(found().size(), 2U);
  EXPECT_TRUE(found().empty()) << "found before";
}

}  // namespace
}  // namespace gnbv
