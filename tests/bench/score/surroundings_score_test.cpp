// What stands around the structure and what lies outside the region count nowhere.
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>

#include "bench/score/cloud_metrics.hpp"
#include "bench/score/mission_score.hpp"
#include "tests/bench/shapes.hpp"

namespace gnbv {
namespace {

/// A cube of 2 m on the floor of the reference, and a fence beside it.
World cube_and_fence() {
  World world;
  test::add_box(world.structure, {-1, -1, 0.5}, {2, 2, 2});
  world.obstacles = box_mesh(Box3(Vec3(3, -2, 0), Vec3(3.2, 2, 3)));
  return world;
}

std::vector<Vec3f> points_on(const TriangleMesh& mesh, double spacing_m) {
  std::vector<Vec3f> points;
  for (const SurfaceSample& sample : sample_surface(mesh, spacing_m)) {
    points.push_back(sample.p_world_m);
  }
  return points;
}

SurfaceReference reference_in(const World& world, const Box3& region_m) {
  ReferenceConfig config;
  config.region_m = region_m;
  return make_surface_reference(world, RayScene(world), config, 2);
}

const Box3 kAll = ReferenceConfig{}.region_m;

void expect_equal(const MissionScore& a, const MissionScore& b) {
  EXPECT_EQ(a.final, b.final);
  EXPECT_EQ(a.final_raw, b.final_raw);
  EXPECT_EQ(a.profile, b.profile);
  EXPECT_EQ(a.accurate, b.accurate);
  EXPECT_EQ(a.curve.accurate, b.curve.accurate);
  EXPECT_EQ(a.curve.coverage, b.curve.coverage);
  EXPECT_EQ(a.density.mean_points, b.density.mean_points);
  EXPECT_EQ(a.distances.chamfer_m, b.distances.chamfer_m);
  for (std::size_t i = 0; i < a.distances.at.size(); ++i) {
    EXPECT_EQ(a.distances.at[i].precision, b.distances.at[i].precision);
    EXPECT_EQ(a.distances.at[i].recall, b.distances.at[i].recall);
  }
}

TEST(SurroundingsScore, PointsBelongToWhatIsNearer) {
  const World world = cube_and_fence();
  const RayScene scene(world);
  const std::vector<Vec3f> points = {
      {1, 0, 1},       // on the cube
      {3, 0, 1},       // on the fence
      {1.9F, 0, 1},    // 0.9 m from the cube, 1.1 m from the fence
      {2.1F, 0, 1},    // 1.1 m and 0.9 m
      {2, 0, 1},       // a metre from either
      {-6, 0, 1},      // far from both: wrong, whoever stands there
      {3.1F, 0, 9.F},  // and this
  };
  EXPECT_EQ(points_of_structure(scene, points, 2),
            (std::vector<std::uint8_t>{1, 0, 1, 0, 1, 1, 1}));
}

TEST(SurroundingsScore, IsThatOfTheCloudWithoutTheirPoints) {
  const World world = cube_and_fence();
  const RayScene scene(world);
  const SurfaceReference reference = reference_in(world, kAll);
  std::vector<Vec3f> own = points_on(world.structure, 0.1);
  own.push_back({-6, 0, 1});
  const std::vector<Vec3f> fence = points_on(world.obstacles, 0.1);
  // of the profile one in two points is the fence's, then all of the fence, then the rest
  std::vector<Vec3f> mixed;
  for (std::size_t i = 0; i < 200; ++i) {
    mixed.push_back(own[i]);
    mixed.push_back(fence[i]);
  }
  std::copy(fence.begin() + 200, fence.end(), std::back_inserter(mixed));
  const std::size_t after_first = mixed.size();
  std::copy(own.begin() + 200, own.end(), std::back_inserter(mixed));

  const ScoredCloud alone{.points_world_m = own,
                          .profile_points = 200,
                          .views = {{.cloud_points = 200}, {.cloud_points = own.size()}}};
  const ScoredCloud both{.points_world_m = mixed,
                         .profile_points = 400,
                         .views = {{.cloud_points = after_first}, {.cloud_points = mixed.size()}}};
  expect_equal(score_cloud(reference, scene, both, 0.2, 2),
               score_cloud(reference, scene, alone, 0.2, 1));
}

TEST(AccurateCoverage, DoesNotRiseByAStrayPointInAVoxelThatNobodySaw) {
  const World world = cube_and_fence();
  const RayScene scene(world);
  const SurfaceReference reference = reference_in(world, kAll);
  const std::vector<Vec3f> on_it = points_on(world.structure, 0.1);
  std::vector<Vec3f> half;  // the lower half of the cube
  std::ranges::copy_if(on_it, std::back_inserter(half), [](const Vec3f& p) { return p.z() < 1; });
  std::vector<Vec3f> strayed = half;
  strayed.push_back({1.02F, 0.02F, 1.52F});  // 20 mm before a wall: 10 mm count at 0.05 m
  const auto score_of = [&](const std::vector<Vec3f>& points) {
    return score_cloud(reference, scene, {.points_world_m = points}, 0.2, 2);
  };
  const MissionScore without = score_of(half);
  const MissionScore with = score_of(strayed);
  EXPECT_EQ(without.accurate, without.final);
  EXPECT_GT(with.final[0], without.final[0]);
  EXPECT_EQ(with.accurate[0], without.accurate[0]);
  EXPECT_EQ(with.accurate[2], with.final[2]);  // in a voxel of 0.5 m it is near enough
  strayed.back().x() = 1.005F;
  EXPECT_EQ(score_of(strayed).accurate, with.final);
}

TEST(SurroundingsScore, AHallAroundTheStructureLeavesTheReference) {
  World world = cube_and_fence();
  const SurfaceReference with_fence = reference_in(world, kAll);
  world.obstacles = {};
  const SurfaceReference alone = reference_in(world, kAll);
  EXPECT_EQ(with_fence, alone);
  test::add_box(world.obstacles, {-4, -4, 0}, {8, 8, 6});  // closed: no line leaves it
  EXPECT_EQ(reference_in(world, kAll), alone);
}

TEST(SurroundingsScore, WhatAnObstacleStandsAgainstIsNotSeen) {
  World world = cube_and_fence();
  const SurfaceReference alone = reference_in(world, kAll);
  world.obstacles = box_mesh(Box3(Vec3(1, -1.5, 0), Vec3(1.5, 1.5, 3)));  // on the face x = 1
  const SurfaceReference beside = reference_in(world, kAll);
  EXPECT_EQ(beside.raw, alone.raw);
  const double face = 1.0 / 6.0;
  const auto share =
      static_cast<double>(beside.counted[0].size()) / static_cast<double>(alone.counted[0].size());
  EXPECT_NEAR(share, 1.0 - face, 0.02);  // but for the voxels of its edges
  for (const Vec3f& p_m : beside.samples_world_m) EXPECT_LT(p_m.x(), 1.0F);
}

TEST(SurroundingsScore, WhatLiesUnderTheTerrainIsNotSeen) {
  World world = cube_and_fence();
  world.obstacles = {};
  const SurfaceReference alone = reference_in(world, kAll);
  test::add_sheet(world.terrain, {-50, -50, 1.5}, {100, 0, 0}, {0, 100, 0});
  world.has_ground = false;
  const SurfaceReference sunk = reference_in(world, kAll);
  EXPECT_EQ(sunk.raw, alone.raw);
  for (const Vec3f& p_m : sunk.samples_world_m) EXPECT_GT(p_m.z(), 1.5F - 1e-3F);
  // of 24 m2 the upper half of the walls and the lid are left
  EXPECT_NEAR(
      static_cast<double>(sunk.counted[0].size()) / static_cast<double>(alone.counted[0].size()),
      12.0 / 24.0, 0.02);
}

TEST(Region, HalvesShareTheReferenceBetweenThem) {
  const World world = cube_and_fence();
  const SurfaceReference whole = reference_in(world, kAll);
  const SurfaceReference east = reference_in(world, Box3(Vec3(0, -9, -9), Vec3(9, 9, 9)));
  const SurfaceReference west = reference_in(world, Box3(Vec3(-9, -9, -9), Vec3(0, 9, 9)));
  for (std::size_t size = 0; size < kCoverageSizes_m.size(); ++size) {
    for (const auto part : {&SurfaceReference::raw, &SurfaceReference::counted}) {
      VoxelSet both;
      std::set_union((east.*part)[size].begin(), (east.*part)[size].end(),
                     (west.*part)[size].begin(), (west.*part)[size].end(),
                     std::back_inserter(both));
      EXPECT_EQ(both, (whole.*part)[size]);
      EXPECT_EQ(both.size(), (east.*part)[size].size() + (west.*part)[size].size());
    }
  }
  EXPECT_EQ(east.points_world_m.size(), east.counted[0].size());
  for (const Vec3f& p_m : east.samples_world_m) EXPECT_GE(p_m.x(), 0.0F);
}

TEST(Region, OfOneSideIsSampledAsCloselyAsTheWhole) {
  World world;
  test::add_box(world.structure, {-5, -5, 0.5}, {10, 10, 10});
  // 100 m2 at 0.025 m are 160,000 samples, of which recall takes what it takes of all six sides
  const SurfaceReference top = reference_in(world, Box3(Vec3(-9, -9, 10.4), Vec3(9, 9, 11)));
  EXPECT_EQ(top.samples_world_m.size(), kAreaSamples);
  for (const Vec3f& p_m : top.samples_world_m) EXPECT_GE(p_m.z(), 10.4F);
}

TEST(Region, PrecisionIsThatOfThePointsInIt) {
  const World world = cube_and_fence();
  const RayScene scene(world);
  const Box3 east(Vec3(0, -9, -9), Vec3(9, 9, 9));
  std::vector<Vec3f> cloud = points_on(world.structure, 0.02);
  cloud.push_back({-6, 0, 1});  // wrong, in the west
  ScoredCloud scored{.points_world_m = cloud, .region_m = east};
  const MissionScore score = score_cloud(reference_in(world, east), scene, scored, 0.2, 2);
  EXPECT_EQ(score.distances.at[0].precision, 1.0);
  EXPECT_EQ(score.distances.at[2].recall, 1.0);
  EXPECT_EQ(score.final[1], 1.0);
  scored.region_m = kAll;
  EXPECT_LT(score_cloud(reference_in(world, kAll), scene, scored, 0.2, 2).distances.at[0].precision,
            1.0);
}

}  // namespace
}  // namespace gnbv
