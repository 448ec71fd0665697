// Who sees a point: from the lattice, between its nodes, with any yaw, by a LIDAR.
#include "bench/limits/sight_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>

#include "bench/limits/free_yaw_camera.hpp"
#include "bench/limits/lidar_sight.hpp"
#include "sim/core/rng.hpp"
#include "tests/bench/limits/limits_setting.hpp"
#include "tests/bench/shapes.hpp"

namespace gnbv {
namespace {

CameraModel camera(double pitch_rad, const Vec3& p_body_m = Vec3::Zero()) {
  return make_camera_model({.range_max_m = 5.0, .p_body_m = p_body_m, .pitch_rad = pitch_rad});
}

/// The nodes of a lattice from `corner` on, all legal and connected.
LegalViewpoints lattice_of(const Vec3& corner, double step_m, const std::array<int, 3>& nodes) {
  LegalViewpoints legal{.step_m = step_m, .start_world_m = corner};
  for (int z = 0; z < nodes[2]; ++z) {
    for (int y = 0; y < nodes[1]; ++y) {
      for (int x = 0; x < nodes[0]; ++x) {
        legal.p_world_m.push_back(corner + step_m * Vec3(x, y, z));
        legal.cell.push_back({x, y, z});
        legal.neighbours.emplace_back();
      }
    }
  }
  return legal;
}

/// A wall of 2 x 2 m at x = 2, and the same behind it at x = 2.5.
TriangleMesh two_walls() {
  TriangleMesh mesh;
  for (const double x : {2.025, 2.525}) {
    test::add_sheet(mesh, Vec3(x, -1.0, 1.0), Vec3(0, 2, 0), Vec3(0, 0, 2));
  }
  return mesh;
}

struct Sight {
  Sight(const TriangleMesh& mesh, const LegalViewpoints& positions, double pitch_rad)
      : Sight(World{mesh, true}, positions, pitch_rad) {}
  Sight(World made, const LegalViewpoints& positions, double pitch_rad)
      : world(std::move(made)),
        scene(world),
        legal(positions),
        cameras{camera(pitch_rad)},
        search(scene, cameras, legal, Box3(Vec3(-9, -9, 0), Vec3(9, 9, 9)), 0.2) {}

  bool from_lattice(const Vec3& point_m, SightSearch::Positions which) const {
    const std::vector<Vec3f> points = {point_m.cast<float>()};
    std::vector<SightItem> items = {{.points_world_m = points}};
    const Eigen::AlignedBox3d box_m(point_m);
    search.look_from_lattice(search.positions_near(box_m), which, items);
    return items[0].is_seen();
  }

  World world;
  RayScene scene;
  LegalViewpoints legal;
  std::vector<CameraModel> cameras;
  SightSearch search;
};

constexpr auto kFew = SightSearch::Positions::first_few;

TEST(SightSearch, SeesTheNearerOfTwoWalls) {
  const Sight sight(two_walls(), lattice_of(Vec3(-1, 0, 2), 1.0, {1, 1, 1}), 0.0);
  for (double y = -0.9; y < 1.0; y += 0.3) {
    EXPECT_TRUE(sight.from_lattice(Vec3(2.025, y, 2.1), kFew)) << y;
    EXPECT_FALSE(sight.from_lattice(Vec3(2.525, y, 2.1), kFew)) << y;
    EXPECT_NE(sight.search.look_out(Vec3f(2.525F, static_cast<float>(y), 2.1F), 0),
              SightSearch::Look::seen);
  }
}

TEST(SightSearch, AGimbalSeesWhatSomePitchOfItDoes) {
  CameraConfig config = camera(0.0).config;
  config.gimbal = GimbalConfig{.min_rad = -0.6, .max_rad = 0.6, .step_rad = 0.6};
  const std::vector<CameraModel> on_gimbal = {make_camera_model(config)};
  const LegalViewpoints one = lattice_of(Vec3(1.025, 0, 2), 1.0, {1, 1, 1});
  Sight any(two_walls(), one, 0.0);
  const SightSearch gimbal(any.scene, on_gimbal, any.legal, Box3(Vec3(-9, -9, 0), Vec3(9, 9, 9)),
                           0.2);
  int of_one_pitch = 0;
  for (double z = 1.05; z < 3.0; z += 0.1) {
    const Vec3 point_m(2.025, 0.1, z);
    const std::vector<Vec3f> points = {point_m.cast<float>()};
    std::vector<SightItem> items = {{.points_world_m = points}};
    gimbal.look_from_lattice(gimbal.positions_near(Eigen::AlignedBox3d(point_m)), kFew, items);
    int pitches = 0;
    for (const double pitch_rad : {-0.6, 0.0, 0.6}) {
      pitches += Sight(two_walls(), one, pitch_rad).from_lattice(point_m, kFew) ? 1 : 0;
    }
    EXPECT_EQ(items[0].is_seen(), pitches > 0) << z;
    of_one_pitch += pitches == 1 ? 1 : 0;
  }
  EXPECT_GT(of_one_pitch, 5);
}

TEST(SightSearch, AllPositionsTogetherSeeWhatEachDoes) {
  TriangleMesh mesh = two_walls();
  test::add_box(mesh, Vec3(0.3, -2.2, 0.6), Vec3(0.7, 0.8, 1.9));
  const LegalViewpoints many = lattice_of(Vec3(-3, -3, 0.5), 0.9, {7, 8, 4});
  ASSERT_GT(many.size(), 200U);
  const Sight all(mesh, many, 0.35);
  std::deque<Sight> each;
  for (const Vec3& p : many.p_world_m) each.emplace_back(mesh, lattice_of(p, 1.0, {1, 1, 1}), 0.35);
  int seen = 0;
  for (double z = 1.1; z < 3.0; z += 0.4) {
    for (double y = -0.9; y < 1.0; y += 0.4) {
      for (const double x : {2.025, 2.525}) {
        const Vec3 point_m(x, y, z);
        const bool any = std::any_of(each.begin(), each.end(), [&](const Sight& one) {
          return one.from_lattice(point_m, kFew);
        });
        EXPECT_EQ(all.from_lattice(point_m, kFew) ||
                      all.from_lattice(point_m, SightSearch::Positions::others),
                  any);
        seen += any ? 1 : 0;
      }
    }
  }
  EXPECT_GT(seen, 10);
}

TEST(SightSearch, FindsPlacesBetweenThePositionsOfTheLattice) {
  // a slit of 0.1 m in a wall in front of a plate: the nodes, 2 m apart, look at it from aside
  TriangleMesh mesh;
  test::add_sheet(mesh, Vec3(3, -0.05, 1.95), Vec3(0, 0.1, 0), Vec3(0, 0, 0.1));
  for (const double y : {-4.05, 0.05}) {
    test::add_sheet(mesh, Vec3(2.5, y, 0.5), Vec3(0, 4, 0), Vec3(0, 0, 3));
  }
  const Sight sight(mesh, lattice_of(Vec3(-1, -1, 2), 2.0, {2, 2, 1}), 0.0);
  const Vec3 plate_m(3, 0, 2);
  EXPECT_FALSE(sight.from_lattice(plate_m, kFew));
  bool is_seen = false;
  for (std::size_t turn = 0; turn < SightSearch::kTurns; ++turn) {
    is_seen =
        is_seen || sight.search.look_out(plate_m.cast<float>(), turn) == SightSearch::Look::seen;
  }
  EXPECT_TRUE(is_seen);
}

TEST(SightSearch, FromAClosedBoxNothingIsOpen) {
  TriangleMesh box;
  test::add_box(box, Vec3(-1, -1, 1), Vec3(2, 2, 2));
  const Sight sight(box, lattice_of(Vec3(-4, -4, 2), 1.0, {9, 2, 2}), 0.0);
  for (std::size_t turn = 0; turn < SightSearch::kTurns; ++turn) {
    EXPECT_EQ(sight.search.look_out(Vec3f(0.3F, 0.2F, 1.5F), turn), SightSearch::Look::closed);
    EXPECT_NE(sight.search.look_out(Vec3f(-1.2F, 0.2F, 1.5F), turn), SightSearch::Look::closed);
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

TEST(SightSearch, NobodySeesTheWallThroughAFence) {
  for (const Fence fence : {Fence::none, Fence::obstacle, Fence::terrain}) {
    // before the fence, at the height of the low point and of the high one
    const Sight sight(walled(fence), lattice_of(Vec3(-1, 0.1, 1.4), 1.2, {1, 1, 2}), 0.0);
    EXPECT_TRUE(sight.from_lattice(Vec3(2, 0.1, 2.6), kFew));
    EXPECT_EQ(sight.from_lattice(Vec3(2, 0.1, 1.4), kFew), fence == Fence::none);
  }
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

TEST(LidarSight, SeesAFaceOfTheBoxAndNeitherItsInsideNorThroughAFence) {
  Scenario scenario = load_scenario("smoke", {});
  TriangleMesh mesh;
  test::add_box(mesh, Vec3(-1, -1, 0.5), Vec3(2, 2, 2));
  test::add_box(mesh, Vec3(-0.5, -0.5, 1), Vec3(1, 1, 1));
  const World world{mesh, true};
  const RayScene scene(world);
  const LidarSight lidars(scenario, scene);
  for (const double z : {0.8, 1.5, 2.2}) {
    const auto up = static_cast<float>(z);
    EXPECT_TRUE(lidars.is_seen(Vec3f(1.0F, 0.3F, up))) << z;
    EXPECT_TRUE(lidars.is_seen(Vec3f(0.2F, -1.0F, up))) << z;
    EXPECT_FALSE(lidars.is_seen(Vec3f(0.5F, 0.1F, up))) << z;
  }
  World fenced = world;  // by an obstacle whose upper end is at 1.6 m
  test::add_box(fenced.obstacles, Vec3(-1.2, -1.2, 0), Vec3(2.4, 2.4, 1.6), false);
  const RayScene fenced_scene(fenced);
  const LidarSight over_the_fence(scenario, fenced_scene);
  EXPECT_FALSE(over_the_fence.is_seen(Vec3f(1.0F, 0.3F, 0.8F)));
  EXPECT_TRUE(over_the_fence.is_seen(Vec3f(1.0F, 0.3F, 2.2F)));
  scenario.planner.profiling.method = ProfilingMethod::none;
  EXPECT_FALSE(LidarSight(scenario, scene).is_seen(Vec3f(1.0F, 0.3F, 1.5F)));
}

}  // namespace
}  // namespace gnbv
