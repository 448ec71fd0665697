// What a view sees of the cluster it was sampled for.
#include <gtest/gtest.h>

#include <cmath>

#include "planner/guided/view_sampling.hpp"
#include "planner/map/frontiers.hpp"
#include "sensors/camera_model.hpp"

namespace gnbv {
namespace {

const Box3 kWorkspace(Vec3(-8, -8, 0), Vec3(8, 8, 8));

OccupancyGrid grid_with(const std::vector<Vec3>& occupied_m) {
  OccupancyGrid grid(OccupancyConfig{}, kWorkspace);
  ScanUpdate update;
  for (const Vec3& p_m : occupied_m) {
    update.occupied.push_back(grid.geometry().index_of(grid.geometry().key_of(p_m)));
  }
  grid.apply(update);
  return grid;
}

FrontierCluster cluster_of(const OccupancyGrid& grid, const Vec3& p_m) {
  const Key key = grid.geometry().key_of(p_m);
  return {{grid.geometry().index_of(key)}, grid.geometry().center_m(key)};
}

const Vec3 kTarget(3.1, 0.1, 4.1);
const ViewPose kFacing{Vec3(0.1, 0.1, 4.1), 0.0};

TEST(Frustum, IsBoundedByFieldOfViewAndRange) {
  const CameraModel camera = make_camera_model({});  // 60 x 45 degrees, 0.3 to 8 m
  const OccupancyGrid grid = grid_with({});
  const auto sees = [&](double x, double y, double z) {
    return !cluster_rejection({&camera, 1}, grid, {{}, Vec3(x, y, z)}, {}, false);
  };
  EXPECT_TRUE(sees(4, 0, 0));
  EXPECT_FALSE(sees(-4, 0, 0));
  EXPECT_TRUE(sees(4, 4 * std::tan(deg_to_rad(29.9)), 0));
  EXPECT_FALSE(sees(4, 4 * std::tan(deg_to_rad(30.1)), 0));
  EXPECT_TRUE(sees(4, 0, -4 * std::tan(deg_to_rad(22.4))));
  EXPECT_FALSE(sees(4, 0, -4 * std::tan(deg_to_rad(22.6))));
  EXPECT_TRUE(sees(7.99, 0, 0));
  EXPECT_FALSE(sees(8.01, 0, 0));
  EXPECT_FALSE(sees(0.29, 0, 0));
}

TEST(ClusterView, RejectsWhatDoesNotLookAtTheCluster) {
  const CameraModel camera = make_camera_model({});
  const OccupancyGrid grid = grid_with({kTarget});
  const FrontierCluster cluster = cluster_of(grid, kTarget);
  const auto verdict = [&](const ViewPose& view) {
    return cluster_rejection({&camera, 1}, grid, cluster, view, true);
  };
  EXPECT_EQ(verdict(kFacing), std::nullopt);
  EXPECT_EQ(verdict({kFacing.p_world_m, kPi}), Rejection::cluster_outside_fov);
}

TEST(ClusterView, RejectsWhatIsHiddenUnlessAskedNotTo) {
  const CameraModel camera = make_camera_model({});
  const OccupancyGrid grid = grid_with({kTarget, Vec3(1.5, 0.1, 4.1)});
  const FrontierCluster cluster = cluster_of(grid, kTarget);
  EXPECT_EQ(cluster_rejection({&camera, 1}, grid, cluster, kFacing, true),
            Rejection::cluster_hidden);
  EXPECT_EQ(cluster_rejection({&camera, 1}, grid, cluster, kFacing, false), std::nullopt);
  // a second voxel of the cluster beside the obstacle is enough
  FrontierCluster wide = cluster;
  const Key beside = grid.geometry().key_of(Vec3(3.1, 1.1, 4.1));
  wide.voxels.push_back(grid.geometry().index_of(beside));
  EXPECT_EQ(cluster_rejection({&camera, 1}, grid, wide, kFacing, true), std::nullopt);
}

TEST(ClusterView, AnyCameraWillDo) {
  CameraConfig up;
  up.pitch_rad = deg_to_rad(-60.0);
  const std::vector<CameraModel> cameras = {make_camera_model(up), make_camera_model({})};
  const OccupancyGrid grid = grid_with({kTarget});
  const FrontierCluster cluster = cluster_of(grid, kTarget);
  EXPECT_EQ(cluster_rejection({cameras.data(), 1}, grid, cluster, kFacing, true),
            Rejection::cluster_outside_fov);
  EXPECT_EQ(cluster_rejection(cameras, grid, cluster, kFacing, true), std::nullopt);
}

}  // namespace
}  // namespace gnbv
