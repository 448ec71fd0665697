// Obstacles and terrain as rays and distances meet them.
#include <gtest/gtest.h>

#include <cmath>

#include "sensors/frames.hpp"
#include "sensors/ray_scene.hpp"
#include "tests/sensors/shapes.hpp"

namespace gnbv {
namespace {

/// From the origin along x: an obstacle at 2 m, the structure at 4 m; terrain at z = -1, and a step
/// of it at z = 1 behind x = 10.
World walled() {
  World world;
  world.has_ground = false;
  test::add_wall(world.structure, 4.0, -1, 1, -0.5, 2);
  test::add_wall(world.obstacles, 2.0, -1, 1, -0.5, 2);
  world.obstacles.materials[0].name = "fence";
  test::add_rectangle(world.terrain, {-20, -20, -1}, {30, 0, 0}, {0, 40, 0});
  test::add_rectangle(world.terrain, {10, -20, 1}, {10, 0, 0}, {0, 40, 0});
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
  std::vector<std::uint8_t> blocked(3);
  scene.find_blocked(kStructurePart, origins, directions, 0.0F, kEndless, blocked);
  EXPECT_EQ(blocked, (std::vector<std::uint8_t>{1, 0, 0}));
  scene.find_blocked(kObstaclePart, origins, directions, 0.0F, kEndless, blocked);
  EXPECT_EQ(blocked, (std::vector<std::uint8_t>{1, 1, 0}));
  scene.find_blocked(kTerrainPart, origins, directions, 0.0F, kEndless, blocked);
  EXPECT_EQ(blocked, (std::vector<std::uint8_t>{0, 0, 1}));
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
}

TEST(Surroundings, AWorldWithoutThemIsAsBefore) {
  World bare = walled();
  bare.obstacles = {};
  bare.terrain = {};
  const RayScene scene(bare);
  EXPECT_FALSE(scene.has_obstacles());
  EXPECT_FALSE(scene.has_terrain());
  EXPECT_TRUE(std::isinf(scene.distance_to_surroundings_m(Vec3(1.5, 0, 1), 9.0)));
  EXPECT_EQ(scene.clearance_m(Vec3(1.5, 0, 1), 9.0),
            scene.distance_to_structure_m(Vec3(1.5, 0, 1), 9.0));
}

}  // namespace
}  // namespace gnbv
