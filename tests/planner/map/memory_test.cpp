#include "planner/map/memory.hpp"

#include <gtest/gtest.h>

namespace gnbv {
namespace {

TEST(MapBytes, AreNoLessThanWhatEveryVoxelHolds) {
  const GridGeometry grid(Box3(Vec3(-2, -2, 0), Vec3(2, 2, 2)), 0.2);
  EXPECT_GE(map_bytes(grid, 1, 2), 22 * grid.voxel_count());
  EXPECT_GE(map_bytes(grid, 4, 2), map_bytes(grid, 1, 2) + 6 * grid.voxel_count());
  EXPECT_EQ(map_bytes(grid, 1, 5), map_bytes(grid, 1, 2) + 3 * grid.voxel_count());
}

TEST(MapBytes, OfAQuarterOfABillionVoxelsAreWithinTheBudget) {
  const GridGeometry fine(Box3(Vec3(-20, -20, 0), Vec3(20, 20, 20)), 0.05);
  const GridGeometry wide(Box3(Vec3(-100, -100, 0), Vec3(100, 100, 50)), 0.2);
  EXPECT_EQ(fine.voxel_count(), 256'000'000U);
  EXPECT_EQ(wide.voxel_count(), 250'000'000U);
  for (const GridGeometry& grid : {fine, wide}) {
    EXPECT_LT(static_cast<double>(map_bytes(grid, 2, 2)), kMapBudget_bytes);
    EXPECT_GT(static_cast<double>(map_bytes(grid, 4, 2)), kMapBudget_bytes);
  }
}

}  // namespace
}  // namespace gnbv
