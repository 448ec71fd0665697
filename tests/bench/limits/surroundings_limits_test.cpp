// Obstacles and no_fly boxes take legal viewpoints as the structure does.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bench/limits/free_yaw_camera.hpp"
#include "bench/limits/lattice_ways.hpp"
#include "bench/limits/legal_viewpoints.hpp"
#include "bench/limits/lidar_sight.hpp"
#include "bench/limits/sight_search.hpp"
#include "scenarios/load.hpp"
#include "sim/core/rng.hpp"
#include "tests/bench/shapes.hpp"

namespace gnbv {
namespace {

constexpr double kRadius_m = 0.5;
const Box3 kRoom(Vec3(-4, -4, 0), Vec3(4, 4, 4));
const Box3 kBlock(Vec3(-1, -2, 0.5), Vec3(1.5, 1, 2.5));
const Vec3 kStart(-3, -3, 1);

LegalViewpoints legal_in(const World& world, const NoFly& no_fly = {}) {
  return find_legal_viewpoints(RayScene(world), kRoom, kRadius_m, 0.4, kStart, 2, no_fly);
}

TEST(SurroundingsLimits, AnObstacleTakesTheRoomOfAStructureOfItsShape) {
  World structure;
  structure.structure = box_mesh(kBlock);
  World obstacle;
  test::add_sheet(obstacle.structure, Vec3(50, 50, 50), Vec3(1, 0, 0), Vec3(0, 1, 0));
  obstacle.obstacles = box_mesh(kBlock);
  const LegalViewpoints by_structure = legal_in(structure);
  const LegalViewpoints by_obstacle = legal_in(obstacle);
  EXPECT_EQ(by_obstacle.p_world_m, by_structure.p_world_m);
  EXPECT_EQ(by_obstacle.neighbours, by_structure.neighbours);
  EXPECT_LT(by_obstacle.size(), 21U * 21U * 11U);
}

TEST(SurroundingsLimits, NoViewpointAndNoWayComesNearerToANoFlyBoxThanTheRadius) {
  World far_away;
  test::add_sheet(far_away.structure, Vec3(50, 50, 50), Vec3(1, 0, 0), Vec3(0, 1, 0));
  const NoFly no_fly{{kBlock}, kRadius_m};
  const RayScene scene(far_away);
  const LegalViewpoints legal =
      find_legal_viewpoints(scene, kRoom, kRadius_m, 0.4, kStart, 2, no_fly);
  EXPECT_GT(legal.size(), 1000U);
  EXPECT_LT(legal.size(), 21U * 21U * 11U);
  for (const Vec3& p_m : legal.p_world_m) EXPECT_GE(kBlock.exteriorDistance(p_m), kRadius_m);

  const auto at = [&](const Vec3& p_m) {
    return static_cast<std::size_t>(std::min_element(legal.p_world_m.begin(), legal.p_world_m.end(),
                                                     [&](const Vec3& a, const Vec3& b) {
                                                       return (a - p_m).norm() < (b - p_m).norm();
                                                     }) -
                                    legal.p_world_m.begin());
  };
  LatticeWays ways(scene, legal, kRadius_m);
  const std::size_t from = at({-3, -0.5, 1.5});
  const std::size_t to = at({3.5, -0.5, 1.5});
  ways.prepare({from}, 1);
  const Way way = ways.way(from, to);
  ASSERT_FALSE(way.via_world_m.empty());  // straight through the box otherwise
  Vec3 at_m = legal.p_world_m[from];
  std::vector<Vec3> points_m = way.via_world_m;
  points_m.push_back(legal.p_world_m[to]);
  for (const Vec3& next_m : points_m) {
    for (int i = 0; i <= 100; ++i) {
      const Vec3 p_m = at_m + 0.01 * i * (next_m - at_m);
      EXPECT_GE(kBlock.exteriorDistance(p_m), kRadius_m - 1e-3);
    }
    at_m = next_m;
  }
}

/// A wall of 2 x 2 m at x = 2 and a lower fence of 1.2 m before it, which is nothing, an obstacle
/// or terrain.
enum class Fence { none, obstacle, terrain };
World walled(Fence fence) {
  World world;
  test::add_sheet(world.structure, Vec3(2, -1, 1), Vec3(0, 2, 0), Vec3(0, 0, 2));
  TriangleMesh mesh;
  test::add_sheet(mesh, Vec3(1.5, -9, 0), Vec3(0, 18, 0), Vec3(0, 0, 2));
  if (fence == Fence::obstacle) world.obstacles = mesh;
  if (fence == Fence::terrain) world.terrain = mesh;
  return world;
}

TEST(SurroundingsLimits, NobodySeesTheWallThroughAFence) {
  const Vec3f low_m(2.0F, 0.1F, 1.4F);
  const Vec3f high_m(2.0F, 0.1F, 2.6F);
  CameraConfig config;
  config.range_max_m = 5.0;
  const std::vector<CameraModel> cameras = {make_camera_model(config)};
  for (const Fence fence : {Fence::none, Fence::obstacle, Fence::terrain}) {
    const World world = walled(fence);
    const RayScene scene(world);
    // a row before the fence, at the height of the low point and of the high one
    LegalViewpoints legal{.step_m = 1.2};
    for (const int up : {0, 1}) {
      legal.p_world_m.emplace_back(-1.0, 0.1, 1.4 + 1.2 * up);
      legal.cell.push_back({0, 0, up});
      legal.neighbours.emplace_back();
    }
    const SightSearch search(scene, cameras, legal, Box3(Vec3(-9, -9, 0), Vec3(9, 9, 9)), 0.2);
    const auto is_seen = [&](const Vec3f& point_m) {
      const std::vector<Vec3f> points = {point_m};
      std::vector<SightItem> items = {{.points_world_m = points}};
      const Eigen::AlignedBox3d box_m(point_m.cast<double>());
      search.look_from_lattice(search.positions_near(box_m), SightSearch::Positions::first_few,
                               items);
      return items[0].is_seen();
    };
    EXPECT_TRUE(is_seen(high_m));
    EXPECT_EQ(is_seen(low_m), fence == Fence::none);
  }
}

TEST(SurroundingsLimits, NoLidarSeesThroughAFence) {
  const Scenario scenario = load_scenario("smoke", {});
  // above the fence that stands around the structure of the workspace
  World world;
  test::add_box(world.structure, Vec3(-1, -1, 0.5), Vec3(2, 2, 2));
  const auto is_seen = [&](double z) {
    const RayScene scene(world);
    return LidarSight(scenario, scene).is_seen(Vec3f(1.0F, 0.3F, static_cast<float>(z)));
  };
  EXPECT_TRUE(is_seen(0.8));
  test::add_box(world.obstacles, Vec3(-1.2, -1.2, 0), Vec3(2.4, 2.4, 1.6), false);
  EXPECT_FALSE(is_seen(0.8));
  EXPECT_TRUE(is_seen(2.2));
}

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

}  // namespace
}  // namespace gnbv
