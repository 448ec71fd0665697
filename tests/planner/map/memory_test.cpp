#include <gtest/gtest.h>

#include "planner/map/grid_geometry.hpp"
#include "planner/planners.hpp"

namespace gnbv {
namespace {

const Box3 kBox_m(Vec3(-2.05, -2, 0), Vec3(2, 2, 2));

double voxels_of(const Box3& box_m, double resolution_m) {
  return static_cast<double>(GridGeometry(box_m, resolution_m).voxel_count());
}

TEST(MapBytes, AreNoLessThanWhatEveryVoxelHolds) {
  const double voxels = voxels_of(kBox_m, 0.2);
  const double bytes = map_bytes(kBox_m, 0.2, 1, 2);
  EXPECT_GE(bytes, 22.0 * voxels);
  EXPECT_GE(map_bytes(kBox_m, 0.2, 4, 2), bytes + 6.0 * voxels);
  EXPECT_EQ(map_bytes(kBox_m, 0.2, 1, 5), bytes + 3.0 * voxels);
}

TEST(MapBytes, OfAQuarterOfABillionVoxelsAreWithinTheBudget) {
  const Box3 fine_m(Vec3(-20, -20, 0), Vec3(20, 20, 20));
  const Box3 wide_m(Vec3(-100, -100, 0), Vec3(100, 100, 50));
  EXPECT_EQ(voxels_of(fine_m, 0.05), 256e6);
  EXPECT_EQ(voxels_of(wide_m, 0.2), 250e6);
  for (const auto& [box_m, resolution_m] : {std::pair{fine_m, 0.05}, std::pair{wide_m, 0.2}}) {
    EXPECT_LT(map_bytes(box_m, resolution_m, 2, 2), kMapBudget_bytes);
    EXPECT_GT(map_bytes(box_m, resolution_m, 4, 2), kMapBudget_bytes);
  }
}

TEST(PlanningBytes, HoldWhatATourKeepsOfEveryVoxelAndCell) {
  PlannerConfig config;
  const double map = map_bytes(kBox_m, config.map.resolution_m, 2, 2);
  EXPECT_EQ(planning_bytes(config, kBox_m, 2, 2), map);
  config.utility.name = "tour";
  const double open_space = 5.0 * voxels_of(kBox_m, config.map.resolution_m);
  EXPECT_GT(planning_bytes(config, kBox_m, 2, 2), map + open_space);
}

}  // namespace
}  // namespace gnbv
