#include "tools/mission/auto_bounds.hpp"

#include <gtest/gtest.h>

#include "planner/motion/config.hpp"
#include "scenarios/load.hpp"
#include "scenarios/problems.hpp"
#include "sim/core/error.hpp"
#include "sim/core/rng.hpp"
#include "sim/mesh/mesh_file.hpp"
#include "tests/bench/shapes.hpp"
#include "tests/support/fault.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/mission/resolve.hpp"

namespace gnbv {
namespace {

Scenario aircraft() { return load_scenario("aircraft", {}); }

bool is_multiple(double x, double step) { return std::abs(x / step - std::round(x / step)) < 1e-9; }

TEST(AutoBounds, MarginFollowsTheLongestRangeAndTheRadius) {
  Scenario scenario = aircraft();
  EXPECT_DOUBLE_EQ(flight_margin_m(scenario), 5.0);
  scenario.cameras[1].range_max_m = 12.0;
  EXPECT_DOUBLE_EQ(flight_margin_m(scenario), 7.5);
  for (CameraConfig& camera : scenario.cameras) camera.range_max_m = 2.0;
  EXPECT_DOUBLE_EQ(flight_margin_m(scenario), 3.5);
}

TEST(AutoBounds, ThePapersAircraftKeepsAboutItsOwnWorkspace) {
  const Scenario out = with_bounds_around(
      aircraft(), {Box3(Vec3(-14.93, -17.68, 0.42), Vec3(14.93, 17.69, 8.09)), {}});
  EXPECT_TRUE(out.workspace_m.min().isApprox(Vec3(-20.0, -22.8, 0.0)));
  EXPECT_TRUE(out.workspace_m.max().isApprox(Vec3(20.0, 22.8, 13.2)));
  EXPECT_TRUE(out.start.pose.p_world_m.isApprox(Vec3(0.0, -22.8, 0.5 * (0.7 + 8.09))));
  EXPECT_DOUBLE_EQ(out.start.pose.yaw_rad, 0.5 * kPi);
}

/// What has to hold around any structure.
void expect_sound(const Scenario& from, const Box3& structure_m) {
  const Scenario out = with_bounds_around(from, {structure_m, {}});
  const double margin_m = flight_margin_m(from);
  const double step_m = from.planner.map.resolution_m;
  const Box3& room = out.workspace_m;
  EXPECT_TRUE(room.contains(structure_m));
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_TRUE(is_multiple(room.min()[axis], step_m)) << room.min()[axis];
    EXPECT_TRUE(is_multiple(room.max()[axis], step_m)) << room.max()[axis];
    if (axis == 2) continue;
    const double below_m = structure_m.min()[axis] - room.min()[axis];
    const double above_m = room.max()[axis] - structure_m.max()[axis];
    // never less than the margin, and less than a voxel more, both but for rounding
    EXPECT_GE(below_m, margin_m - 1e-5);
    EXPECT_GE(above_m, margin_m - 1e-5);
    EXPECT_LT(std::max(below_m, above_m), margin_m + step_m + 1e-5);
  }
  EXPECT_GE(room.max().z() - structure_m.max().z(), margin_m - 1e-5);
  const ViewPose& start = out.start.pose;
  EXPECT_TRUE(navigation_box_m(out.planner.validity, room).contains(start.p_world_m));
  EXPECT_GE(structure_m.min().y() - start.p_world_m.y(), out.planner.validity.collision_radius_m);
  const Vec3 to_centre = structure_m.center() - start.p_world_m;
  EXPECT_NEAR(std::atan2(to_centre.y(), to_centre.x()), start.yaw_rad, 1e-12);
  EXPECT_TRUE(problems(out).empty());
}

TEST(AutoBounds, EveryStructureGetsRoomOnTheLatticeAndALegalStart) {
  std::uint64_t index = 0;
  const auto random = [&](double low, double high) {
    return low + (high - low) * uniform01({5, Stream::bench, 0, index++});
  };
  for (int round = 0; round < 200; ++round) {
    const Vec3 low(random(-300, 300), random(-300, 300), random(-20, 60));
    const Vec3 size(random(0.2, 40), random(0.2, 40), random(0.2, 40));
    Scenario scenario = aircraft();
    scenario.structure.ground = round % 3 != 0;
    scenario.planner.map.resolution_m = round % 2 == 0 ? 0.2 : 0.3;
    expect_sound(scenario, Box3(low, Vec3(low + size)));
  }
  expect_sound(load_scenario("smoke", {}), Box3(Vec3(-1, -1, 0), Vec3(1, 1, 1.6)));
}

TEST(AutoBounds, FloorIsTheGroundUnlessTheStructureSinksOrFloatsAway) {
  const std::tuple<bool, double, double> cases[] = {
      {true, 0.0, 0.0},   {true, 4.9, 0.0},    {true, -5e-4, 0.0},  // written numbers are rounded
      {true, -1.9, -2.0}, {true, 100.0, 95.0}, {true, -50.0, -50.0}, {false, 0.0, -5.0}};
  for (const auto& [has_ground, lowest_m, floor_m] : cases) {
    Scenario scenario = aircraft();
    scenario.structure.ground = has_ground;
    const Box3 structure_m(Vec3(-1, -1, lowest_m), Vec3(1, 1, lowest_m + 2));
    EXPECT_NEAR(with_bounds_around(scenario, {structure_m, {}}).workspace_m.min().z(), floor_m,
                1e-9);
  }
}

/// A slender mast with a cabin on top, 28 m above the ground.
TriangleMesh lookout() {
  TriangleMesh mesh;
  test::add_box(mesh, {-0.15, -0.15, 0}, {0.3, 0.3, 28});
  test::add_box(mesh, {-5, -5, 28}, {10, 10, 4});
  return mesh;
}

TEST(AutoBounds, TheStartIsWhereMostIsToBeSeen) {
  const Scenario out = with_bounds_around(aircraft(), extent_of(lookout()));
  EXPECT_GT(out.start.pose.p_world_m.z(), 26.0);
  EXPECT_LE(std::abs(out.start.pose.p_world_m.x()), 5.0);
  EXPECT_EQ(out.start.pose.p_world_m.y(), out.workspace_m.min().y());
}

TEST(AutoBounds, AStartAtTheBoxsLowestEdgeIsInTheBox) {
  // a plate on the ground just within the cameras' range, if they are low, and wires of any height
  int lowest = 0;
  for (int round = 0; round < 60; ++round) {
    TriangleMesh mesh;
    test::add_box(mesh, {0, -3, 0}, {0.01, 0.01, 1.5 + 0.317 * round});
    test::add_box(mesh, {-6, -0.6, 0}, {12, 3.6, 0.1});
    const Scenario out = with_bounds_around(aircraft(), extent_of(mesh));
    lowest += out.start.pose.p_world_m.z() < out.planner.validity.z_min_m + 1e-9;
    EXPECT_TRUE(problems(out).empty()) << problems(out).front().what;
  }
  EXPECT_GT(lowest, 20) << "the test is about another start";
}

TEST(AutoBounds, WhatTheUserSaysWinsAndWhatDoesNotFitIsRefusedByItsOwnName) {
  const TempFolder temp;
  write_mesh(lookout(), temp.path() / "t.obj");
  ScenarioOptions options;
  options.scenario = "aircraft";
  options.mesh = (temp.path() / "t.obj").string();
  options.bounds_auto = true;
  const auto resolved = [&](const std::vector<std::string>& sets) {
    options.overrides = sets;
    return resolve_scenario(options);
  };
  // outside the scenario's own workspace, and outside what would be laid around the structure
  const std::string far = "start.position_m=[0, -30, 35]";
  const Scenario start = resolved({far});
  EXPECT_EQ(start.start.pose.p_world_m, Vec3(0, -30, 35));
  EXPECT_LE(start.workspace_m.min().y(), -30.0);
  EXPECT_GE(start.workspace_m.max().y(), 10.0);
  EXPECT_NEAR(start.start.pose.yaw_rad, 0.5 * kPi, 1e-9);
  EXPECT_NEAR(resolved({"start={yaw_deg: 10}"}).start.pose.yaw_rad, deg_to_rad(10.0), 1e-12);
  const std::string narrow = "workspace_m={min: [-9, -9, 0], max: [9, 9, 40]}";
  const Scenario room = resolved({narrow});
  EXPECT_EQ(room.workspace_m.min(), Vec3(-9, -9, 0));
  EXPECT_EQ(room.workspace_m.max(), Vec3(9, 9, 40));
  EXPECT_TRUE(room.workspace_m.contains(room.start.pose.p_world_m));
  EXPECT_GT(room.start.pose.p_world_m.z(), 26.0);
  EXPECT_TRUE(room.planner.object_bounds_m.contains(room.workspace_m));
  EXPECT_EQ(resolved({"planner.object_bounds_m.max=[9, 9, 8]"}).planner.object_bounds_m.max(),
            Vec3(9, 9, 8));
  const std::string fault = test::fault_of([&] { resolved({narrow, far}); });
  EXPECT_TRUE(test::says(fault, {"--set start.position_m"}));
}

TEST(AutoBounds, WhatNoMapCanHoldIsSaidByItsProblems) {
  const auto complaint = [](const Box3& structure_m) -> std::string {
    const auto all = problems(with_bounds_around(aircraft(), {structure_m, {}}));
    return all.empty() ? "" : all.front().keys.front() + all.front().what;
  };
  // distances are right up to 1000 m; 32767 voxels of 0.2 m would reach 6553 m
  EXPECT_EQ(complaint(Box3(Vec3(900, 0, 0), Vec3(905, 1, 1))), "");
  EXPECT_NE(complaint(Box3(Vec3(1000, 0, 0), Vec3(1005, 1, 1))).find("1000 m"), std::string::npos);
  EXPECT_NE(complaint(Box3(Vec3(6550, 0, 0), Vec3(6552, 1, 1))).find("OctoMap"), std::string::npos);
  EXPECT_NE(complaint(Box3(Vec3(0, 0, 0), Vec3(900, 900, 90))).find("resolution_m"),
            std::string::npos);
}

}  // namespace
}  // namespace gnbv
