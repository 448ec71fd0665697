// What is listed of a view is what was counted of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "planner/view/visibility.hpp"
#include "tests/planner/view/view_scene.hpp"

namespace gnbv {
namespace {

TEST(VoxelsInSight, AreThoseThatTheUtilityCounts) {
  const RandomScene scene;
  const CameraModel left = make_camera_model({.range_max_m = 5.0});
  const CameraModel right =
      make_camera_model({.fov_x_rad = 0.6, .fov_y_rad = 0.4, .range_max_m = 3.0});
  const std::array cameras = {left, right};
  const ViewRays rays = make_view_rays(cameras, scene.grid.geometry().resolution_m());
  VisitMarks marks(scene.grid.geometry().voxel_count());
  std::size_t predicted = 0;
  for (std::uint64_t i = 0; i < 40; ++i) {
    const ViewPose pose = RandomScene::pose(i);
    const ViewStats stats = evaluate_view(scene.grid, scene.cloud, rays, pose, marks);
    const VoxelsInSight seen = voxels_in_sight(scene.grid, rays, pose);
    EXPECT_EQ(seen.unknown.size(), stats.unknown_voxels) << i;
    EXPECT_EQ(seen.predicted.size(), stats.predicted_voxels) << i;
    EXPECT_TRUE(std::is_sorted(seen.unknown.begin(), seen.unknown.end()));
    for (const VoxelIndex v : seen.unknown) {
      EXPECT_EQ(scene.grid.state(v), VoxelState::unknown);
    }
    for (const VoxelIndex v : seen.predicted) EXPECT_TRUE(scene.grid.is_predicted(v));
    predicted += seen.predicted.size();
  }
  EXPECT_GT(predicted, 100U);
}

TEST(VoxelsInSight, EndAtTheFirstOccupiedVoxel) {
  Corridor corridor(12);
  for (const VoxelIndex v : {0, 1, 2}) {
    for (int i = 0; i < 3; ++i) corridor.miss(v);
  }
  for (int i = 0; i < 3; ++i) corridor.hit(8);
  for (const VoxelIndex v : {5, 6, 10}) corridor.grid.predict(v);
  const VoxelsInSight seen =
      voxels_in_sight(corridor.grid, Corridor::one_ray(5.0), {Vec3(0.1, 0.1, 0.1), 0.0});
  EXPECT_EQ(seen.unknown, (std::vector<VoxelIndex>{3, 4, 5, 6, 7}));
  EXPECT_EQ(seen.predicted, (std::vector<VoxelIndex>{5}));
}

}  // namespace
}  // namespace gnbv
