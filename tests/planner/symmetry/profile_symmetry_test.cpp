// Symmetry in what the LIDAR really sees of the two structures, built in and the paper's own.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "assets/catalog.hpp"
#include "planner/symmetry/symmetry.hpp"
#include "sim/mesh/mesh_file.hpp"
#include "tests/support/swept_profile.hpp"

namespace gnbv {
namespace {

constexpr double kSweepSpacing_m = 0.2;  // a mission's is 0.05 m and less; figures change little
const Box3 kAircraftWorkspace(Vec3(-20, -20, 0), Vec3(20, 20, 20));
const Box3 kPlantWorkspace(Vec3(-25, -16, 0), Vec3(25, 16, 12));

test::SweptProfile aircraft_profile(const World& world, int descents,
                                    const LidarConfig& lidar = {}) {
  const ViewPose start = {Vec3(0, -20, 5), 0.5 * kPi};
  return test::sweep_profile(world, kAircraftWorkspace, start, descents, kSweepSpacing_m, lidar);
}

test::SweptProfile plant_profile(const World& world, int descents) {
  const ViewPose start = {Vec3(0, -16, 5), 0.5 * kPi};
  return test::sweep_profile(world, kPlantWorkspace, start, descents, kSweepSpacing_m);
}

Symmetry symmetry_of(const test::SweptProfile& profile) {
  return find_symmetry({}, profile.belief.cloud.points_world_m(), profile.belief.grid);
}

void expect_plane_x_0(const Symmetry& symmetry) {
  ASSERT_TRUE(symmetry.plane) << "support " << symmetry.support;
  EXPECT_GT(symmetry.plane->normal_world.x(), std::cos(deg_to_rad(1.0)));
  EXPECT_LT(std::fabs(symmetry.plane->offset_m), 0.10);
  EXPECT_GT(symmetry.support, 0.99);
}

/// Share of the predicted voxels whose centre is within a voxel of the surface.
double share_on_surface(const OccupancyGrid& grid, const RayScene& scene) {
  const GridGeometry& geometry = grid.geometry();
  const double voxel_m = geometry.resolution_m();
  std::size_t near = 0;
  for (VoxelIndex v = 0; v < geometry.voxel_count(); ++v) {
    if (!grid.is_predicted(v)) continue;
    const Vec3 center_m = geometry.center_m(geometry.key_at(v));
    near += scene.distance_to_structure_m(center_m, 2.0 * voxel_m) <= voxel_m;
  }
  return static_cast<double>(near) / static_cast<double>(grid.predicted_count());
}

void expect_prediction_from_three_waypoints(const World& world) {
  test::SweptProfile profile = aircraft_profile(world, 3);
  const Symmetry symmetry = symmetry_of(profile);
  expect_plane_x_0(symmetry);
  // measured: 2,300 to 2,600 voxels, all of them on the surface
  EXPECT_GT(predict_surface(symmetry, profile.belief.grid), 1500U);
  EXPECT_GT(share_on_surface(profile.belief.grid, RayScene(world)), 0.97);
}

void expect_little_to_predict_from_eight_waypoints(const World& world) {
  test::SweptProfile profile = aircraft_profile(world, 8);
  const Symmetry symmetry = symmetry_of(profile);
  expect_plane_x_0(symmetry);
  // measured: 50 to 210 of 8,000 to 9,000 occupied voxels
  EXPECT_LT(predict_surface(symmetry, profile.belief.grid),
            profile.belief.grid.occupied_count() / 20);
}

void expect_none(const World& world) {
  for (const int descents : {3, 8}) {
    const Symmetry symmetry = symmetry_of(plant_profile(world, descents));
    EXPECT_FALSE(symmetry.plane) << descents << " descents, support " << symmetry.support;
    // measured: 0.53 and 0.96 at most, against 0.996 at least where there is symmetry
    EXPECT_LT(symmetry.support, SymmetryConfig{}.min_support - 0.015);
  }
}

/// The world with that file of the paper, if this machine has it.
std::optional<World> paper_world(const char* name, double scale, const Vec3& offset_m) {
  MeshFileConfig file;
  file.path = (std::filesystem::path(GNBV_SHARED_MESHES) / name).string();
  file.scale = scale;
  file.offset_m = offset_m;
  if (!std::filesystem::exists(file.path)) return std::nullopt;
  return World{load_mesh(file)};
}

TEST(ProfileSymmetry, OfTheAircraftPredictsTheFarSideFromThreeWaypoints) {
  expect_prediction_from_three_waypoints({make_builtin_structure("aircraft")});
}

TEST(ProfileSymmetry, OfTheAircraftPredictsNextToNothingFromEight) {
  expect_little_to_predict_from_eight_waypoints({make_builtin_structure("aircraft")});
}

TEST(ProfileSymmetry, IsNotInventedForThePowerPlant) {
  expect_none({make_builtin_structure("power_plant")});
}

TEST(ProfileSymmetry, SurvivesNoisyRanges) {
  LidarConfig noisy;
  noisy.range_sigma_m = 0.05;
  const World world = {make_builtin_structure("aircraft")};
  test::SweptProfile profile = aircraft_profile(world, 3, noisy);
  const Symmetry symmetry = symmetry_of(profile);
  expect_plane_x_0(symmetry);
  predict_surface(symmetry, profile.belief.grid);
  EXPECT_GT(share_on_surface(profile.belief.grid, RayScene(world)), 0.9);
}

TEST(PaperMeshSymmetry, OfTheA340PredictsTheFarSideFromThreeWaypoints) {
  const auto world = paper_world("a340.obj", 1.0, Vec3::Zero());
  if (!world) GTEST_SKIP() << "a340.obj is not here";
  expect_prediction_from_three_waypoints(*world);
}

TEST(PaperMeshSymmetry, OfTheA340PredictsNextToNothingFromEight) {
  const auto world = paper_world("a340.obj", 1.0, Vec3::Zero());
  if (!world) GTEST_SKIP() << "a340.obj is not here";
  expect_little_to_predict_from_eight_waypoints(*world);
}

TEST(PaperMeshSymmetry, IsNotInventedForThePowerPlant) {
  const auto world = paper_world("powerplant.dae", 0.25, Vec3(0.74, -0.79, 0.0));
  if (!world) GTEST_SKIP() << "powerplant.dae is not here";
  expect_none(*world);
}

}  // namespace
}  // namespace gnbv
