#include "bench/limits/seen_voxels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/core/rng.hpp"
#include "tests/bench/shapes.hpp"

namespace gnbv {
namespace {

CameraModel camera(double pitch_rad, const Vec3& p_body_m = Vec3::Zero()) {
  CameraConfig config;
  config.pitch_rad = pitch_rad;
  config.p_body_m = p_body_m;
  config.range_max_m = 5.0;
  return make_camera_model(config);
}

/// Whether the point is in the image and range from there; `slack` widens both.
bool is_in_image(const CameraModel& model, const ViewPose& view, const Vec3& point_m,
                 double slack) {
  const CameraConfig& c = model.config;
  const Vec3 p = (T_world_body(view) * model.T_body_camera).inverse() * point_m;
  return p.z() >= c.range_min_m - slack && p.z() <= c.range_max_m + slack &&
         std::abs(p.x()) <= p.z() * std::tan(0.5 * c.fov_x_rad) + slack &&
         std::abs(p.y()) <= p.z() * std::tan(0.5 * c.fov_y_rad) + slack;
}

Vec3 random_point(std::uint64_t index) {
  const auto u = [&](std::uint64_t axis) {
    return 12.0 * uniform01({9, Stream::bench, index, axis}) - 6.0;
  };
  return {u(0), u(1), u(2)};
}

TEST(FreeYawCamera, HasInItsImageWhatSomeYawHas) {
  // the brute force: every tenth of a degree. The bearings tried leave out slivers between them.
  constexpr double kSliver_m = 0.12;
  for (const double pitch_rad : {0.0, 0.35, -0.8}) {
    const CameraModel model = camera(pitch_rad, Vec3(0.1, 0.0, -0.2));
    const FreeYawCamera free_yaw(model);
    int found = 0;
    int missed = 0;
    for (std::uint64_t i = 0; i < 300; ++i) {
      const Vec3 vehicle_m(0.5, -0.3, 0.2);
      const Vec3 point_m = random_point(i);
      bool some_yaw = false;
      bool some_yaw_easily = false;
      for (int k = 0; k < 3600; ++k) {
        const ViewPose view{vehicle_m, 2.0 * kPi * k / 3600.0};
        some_yaw = some_yaw || is_in_image(model, view, point_m, 0.02);
        some_yaw_easily = some_yaw_easily || is_in_image(model, view, point_m, -kSliver_m);
      }
      const auto origin_m = free_yaw.origin_world_m(vehicle_m, point_m);
      EXPECT_TRUE(!origin_m || some_yaw) << i;
      missed += !origin_m && some_yaw_easily ? 1 : 0;
      if (!origin_m) continue;
      ++found;
      EXPECT_NEAR((*origin_m - vehicle_m).norm(), model.config.p_body_m.norm(), 1e-9);
      EXPECT_LE((point_m - vehicle_m).norm(), free_yaw.reach_m());
    }
    EXPECT_GT(found, 30);
    EXPECT_LE(missed, 1) << found;
  }
}

/// A wall of 2 x 2 m at x = 2, and the same behind it at x = 2.5.
TriangleMesh two_walls() {
  TriangleMesh mesh;
  for (const double x : {2.025, 2.525}) {
    test::add_sheet(mesh, Vec3(x, -1.0, 1.0), Vec3(0, 2, 0), Vec3(0, 0, 2));
  }
  return mesh;
}

VoxelSet seen_from(const TriangleMesh& mesh, const std::vector<Vec3>& positions_m,
                   const CameraModel& model, int threads = 2) {
  const World world{mesh, true};
  const std::vector<CameraModel> cameras = {model};
  return seen_voxels(world, RayScene(world), cameras, positions_m, {}, threads);
}

TEST(SeenVoxels, AreThoseOfTheNearerOfTwoWalls) {
  const VoxelSet seen = seen_from(two_walls(), {Vec3(-1.0, 0.0, 2.0)}, camera(0.0));
  EXPECT_EQ(seen.size(), 40U * 40U);  // 2 m in 5 cm voxels
  for (const std::uint64_t code : seen) EXPECT_NEAR(voxel_centre_m(code, 0.05).x(), 2.025, 1e-9);
}

TEST(SeenVoxels, EndWhereTheImageAndTheRangeEnd) {
  // 22.5 degrees up and down at 3 m: 1.24 m, more than the wall; at 1 m: 0.41 m
  const VoxelSet near = seen_from(two_walls(), {Vec3(1.025, 0.0, 2.0)}, camera(0.0));
  const double half_m = std::tan(deg_to_rad(22.5));
  ASSERT_FALSE(near.empty());
  for (const std::uint64_t code : near) {
    // sideways the sample comes to the middle of the image, but there it is farther away
    const Vec3 centre_m = voxel_centre_m(code, 0.05);
    const double level_m = std::hypot(1.0, centre_m.y());
    EXPECT_LE(std::abs(centre_m.z() - 2.0), half_m * level_m + 0.06);
  }
  // depth is measured along the axis: at the image's edge, 30 degrees aside, 5 m reach 5.77 m
  EXPECT_FALSE(seen_from(two_walls(), {Vec3(-3.6, 0.0, 2.0)}, camera(0.0)).empty());
  EXPECT_TRUE(seen_from(two_walls(), {Vec3(-3.8, 0.0, 2.0)}, camera(0.0)).empty());
  EXPECT_TRUE(seen_from(two_walls(), {}, camera(0.0)).empty());
}

TEST(SeenVoxels, OfManyPositionsAreThoseOfEachTogether) {
  TriangleMesh mesh = two_walls();
  test::add_box(mesh, Vec3(0.3, -2.2, 0.6), Vec3(0.7, 0.8, 1.9));
  std::vector<Vec3> positions_m;
  for (std::uint64_t i = 0; i < 12; ++i) positions_m.emplace_back(random_point(i) * 0.7);
  VoxelSet together;
  for (const Vec3& p : positions_m) {
    const VoxelSet seen = seen_from(mesh, {p}, camera(0.35));
    together.insert(together.end(), seen.begin(), seen.end());
  }
  std::sort(together.begin(), together.end());
  together.erase(std::unique(together.begin(), together.end()), together.end());
  ASSERT_GT(together.size(), 100U);
  EXPECT_EQ(seen_from(mesh, positions_m, camera(0.35), 1), together);
  EXPECT_EQ(seen_from(mesh, positions_m, camera(0.35), 5), together);
}

}  // namespace
}  // namespace gnbv
