#include <gtest/gtest.h>

#include <cmath>

#include "sensors/capture.hpp"
#include "sensors/frames.hpp"
#include "sensors/ray_scene.hpp"
#include "tests/sensors/shapes.hpp"

namespace gnbv {
namespace {

using test::add_wall;
using test::world_of;

/// One beam exactly forward: an odd number of them.
LidarConfig lidar_with(double pitch_rad) { return {.beams = 721, .pitch_rad = pitch_rad}; }
constexpr std::size_t kForward = 360;

/// A sweep from one place.
LidarScan sweep(const RayScene& scene, const LidarConfig& lidar, const Isometry& T_world_body,
                const NoiseKey& key = {}) {
  return capture_scan(scene, make_lidar_model(lidar), 0, {&T_world_body, 1}, 0.0, key);
}

TEST(LidarCapture, DefaultTiltPointsTheFanDownTenDegrees) {
  const RayScene scene(world_of({}, true));
  const LidarConfig lidar = lidar_with(LidarConfig{}.pitch_rad);
  const LidarScan scan = sweep(scene, lidar, T_world_body({{3, 4, 2.0}, 1.1}));
  for (int beam = 0; beam < lidar.beams; ++beam) {
    const double azimuth_rad = deg_to_rad(-90.0 + 0.25 * beam);
    const double expected_m = 2.0 / (std::sin(deg_to_rad(10.0)) * std::cos(azimuth_rad));
    const float range_m = scan.range_m[static_cast<std::size_t>(beam)];
    if (expected_m < 29.9) {
      ASSERT_NEAR(range_m, expected_m, 1e-5 * expected_m) << beam;  // float rays, slant up to 1:15
    } else if (expected_m > 30.1 || azimuth_rad < -1.57 || azimuth_rad > 1.57) {
      ASSERT_EQ(range_m, kNoReturn) << beam;
    }
  }
}

TEST(LidarCapture, BeamsRunCounterClockwiseFromTheRightAndWhatIsTooNearHides) {
  TriangleMesh panels;  // 1 m wide: right at 2 m, ahead at 3 m, left at 4 m; and 45 degrees right
  test::add_sheet(panels, {0.03, -0.05, -1}, {0.02, 0.02, 0}, {0, 0, 2});
  test::add_sheet(panels, {1, -2, -1}, {1, 1, 0}, {0, 0, 2});
  test::add_sheet(panels, {-0.5, -2, -1}, {1, 0, 0}, {0, 0, 2});
  add_wall(panels, 3.0, -0.5, 0.5, -1, 1);
  test::add_sheet(panels, {-0.5, 4, -1}, {1, 0, 0}, {0, 0, 2});
  const RayScene scene(world_of(panels, false));
  const LidarScan scan = sweep(scene, lidar_with(0.0), Isometry::Identity());
  ASSERT_EQ(scan.range_m.size(), 721U);
  EXPECT_NEAR(scan.range_m.front(), 2.0, 1e-5);
  EXPECT_NEAR(scan.range_m[kForward], 3.0, 1e-5);
  EXPECT_NEAR(scan.range_m.back(), 4.0, 1e-5);
  EXPECT_TRUE(std::isnan(scan.range_m[kForward / 2]));
  EXPECT_EQ(scan.range_m[kForward * 3 / 2], kNoReturn);
}

TEST(LidarCapture, EqualsBruteForceAtEveryBeam) {
  const TriangleMesh soup = test::random_soup(60, 3.0, {0, 0, 0}, 23);
  const RayScene scene(world_of(soup, false));
  LidarConfig lidar;
  lidar.p_body_m = {0.1, 0.0, -0.05};
  lidar.range_max_m = 4.0;  // about the middle of the triangles
  const LidarScan scan = sweep(scene, lidar, T_world_body({{-4, 0.5, 1}, 0.2}));
  int compared = 0, beyond = 0;
  for (int beam = 0; beam < lidar.beams; ++beam) {
    const Vec3 direction = scan.T_world_lidar.linear() * beam_lidar(lidar, beam).cast<double>();
    const test::BruteHit expected =
        test::brute_first_hit(soup, scan.T_world_lidar.translation(), direction);
    if (expected.is_near_edge || std::abs(expected.distance - 4.0) < 1e-4) continue;
    const float range_m = scan.range_m[static_cast<std::size_t>(beam)];
    if (expected.distance > 4.0) {  // a sphere
      ASSERT_EQ(range_m, kNoReturn) << beam;
      beyond += std::isinf(expected.distance) ? 0 : 1;
    } else {
      ASSERT_NEAR(range_m, expected.distance, 5e-5) << beam;  // float rays under a slant
    }
    ++compared;
  }
  EXPECT_GT(compared, 690);
  EXPECT_GT(beyond, 5);
}

// Obstacles and terrain as rays and distances meet them.

/// From the origin along x: an obstacle at 2 m, the structure at 4 m; terrain at z = -1, and a step
/// of it at z = 1 behind x = 10.
World walled() {
  World world;
  world.has_ground = false;
  test::add_wall(world.structure, 4.0, -1, 1, -0.5, 2);
  test::add_wall(world.obstacles, 2.0, -1, 1, -0.5, 2);
  world.obstacles.materials[0].name = "fence";
  test::add_sheet(world.terrain, {-20, -20, -1}, {30, 0, 0}, {0, 40, 0});
  test::add_sheet(world.terrain, {10, -20, 1}, {10, 0, 0}, {0, 40, 0});
  world.terrain.materials[0].name = "soil";
  world.terrain_floor_z_m = 0.0;
  return world;
}

TEST(Surroundings, FacesAreNumberedBehindThoseOfTheStructure) {
  const RayScene scene(walled());
  const std::vector<Vec3f> origins = {{0, 0, 1}, {3, 0, 1}, {0, 0, 0.5F}};
  const std::vector<Vec3f> directions = {{1, 0.1F, 0.01F}, {1, 0.1F, 0.01F}, {0.1F, 0.2F, -1}};
  std::vector<RayHit> hits(3);
  scene.first_hits(origins, directions, 0.0F, 100.0F, hits);
  EXPECT_NEAR(hits[0].distance_m, 2.0, 1e-6);
  EXPECT_GE(hits[0].face, 2);
  EXPECT_LE(hits[0].face, 3);
  EXPECT_EQ(scene.material(hits[0].face).name, "fence");
  EXPECT_NEAR(std::abs(scene.normal_world(hits[0].face).x()), 1.0, 1e-6);
  EXPECT_LE(hits[1].face, 1);  // the structure's own
  EXPECT_EQ(scene.material(hits[1].face).name, "default");
  EXPECT_NEAR(hits[2].distance_m, 1.5, 1e-6);
  EXPECT_GE(hits[2].face, 4);
  EXPECT_EQ(scene.material(hits[2].face).name, "soil");
  EXPECT_NEAR(scene.normal_world(hits[2].face).z(), 1.0, 1e-6);
}

TEST(Surroundings, EachPartBlocksForItself) {
  const RayScene scene(walled());
  const std::vector<Vec3f> origins = {{0, 0, 1}, {3, 0, 1}, {0, 0, 1}};
  const std::vector<Vec3f> directions = {{1, 0, 0}, {-1, 0, 0}, {0, 0, -1}};
  using Blocked = std::vector<std::uint8_t>;
  for (const auto& [part, expected] :
       {std::pair(kStructurePart, Blocked{1, 0, 0}), std::pair(kObstaclePart, Blocked{1, 1, 0}),
        std::pair(kTerrainPart, Blocked{0, 0, 1})}) {
    Blocked blocked(3);
    scene.find_blocked(part, origins, directions, 0.0F, kEndless, blocked);
    EXPECT_EQ(blocked, expected);
  }
}

TEST(Surroundings, DistancesAreOfThePartsThatAreAsked) {
  const RayScene scene(walled());
  const Vec3 p(1.5, 0, 1);
  EXPECT_NEAR(scene.distance_to_structure_m(p, 9.0), 2.5, 1e-12);
  EXPECT_NEAR(scene.distance_to_surroundings_m(p, 9.0), 0.5, 1e-12);
  EXPECT_NEAR(scene.clearance_m(p, 9.0), 0.5, 1e-12);
  // low over the terrain: near to it, but it is ground there
  const Vec3 low(-5, 0, -0.5);
  EXPECT_NEAR(scene.distance_to_surroundings_m(low, 9.0), 0.5, 1e-12);
  EXPECT_NEAR(scene.clearance_m(low, 9.0), 7.0, 1e-12);  // to the fence
  // the step rises above the floor: in the way
  EXPECT_NEAR(scene.clearance_m(Vec3(15, 0, 1.25), 9.0), 0.25, 1e-12);
  EXPECT_TRUE(std::isinf(scene.clearance_m(Vec3(15, 0, 1.25), 0.2)));
  World bare = walled();
  bare.obstacles = bare.terrain = {};
  const RayScene alone(bare);
  EXPECT_FALSE(alone.has_obstacles() || alone.has_terrain());
  EXPECT_TRUE(std::isinf(alone.distance_to_surroundings_m(p, 9.0)));
  EXPECT_EQ(alone.clearance_m(p, 9.0), alone.distance_to_structure_m(p, 9.0));
}

}  // namespace
}  // namespace gnbv
