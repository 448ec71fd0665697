// What is refused before a mission begins.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "sim/core/error.hpp"
#include "tests/bench/shapes.hpp"
#include "tests/support/fault.hpp"
#include "tests/support/flown.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/mission/reference.hpp"
#include "tools/mission/start_pose.hpp"

namespace gnbv {
namespace {

using testing::StartsWith;

/// A hall of thin walls around the aircraft scenario's middle, with its north wall from x = -8 to
/// `wall_to_m`.
World hall(double wall_to_m) {
  World world{TriangleMesh{}, true};
  test::add_sheet(world.structure, {-8, -8, 0}, {16, 0, 0}, {0, 0, 10});
  test::add_sheet(world.structure, {-8, -8, 0}, {0, 16, 0}, {0, 0, 10});
  test::add_sheet(world.structure, {8, -8, 0}, {0, 16, 0}, {0, 0, 10});
  test::add_sheet(world.structure, {-8, -8, 10}, {16, 0, 0}, {0, 16, 0});
  test::add_sheet(world.structure, {-8, -8, 0}, {16, 0, 0}, {0, 16, 0});
  test::add_sheet(world.structure, {-8, 8, 0}, {wall_to_m + 8, 0, 0}, {0, 0, 10});
  return world;
}

std::string fault_of(const Scenario& scenario, const World& world, const Vec3& start_m) {
  const RayScene scene(world);
  return test::fault_of([&] {
    need_way_out(scenario, scene, bounds_m(world.structure), {start_m, 0.0}, 2);
  });
}

std::string fault_of_world(const Scenario& scenario) {
  return test::fault_of([&] { world_of(scenario); });
}

TEST(LoadWorld, AMeshOutsideTheWorkspaceIsNamedWithTheLineThatPlacedItThere) {
  const TempFolder temp;
  const std::string mesh = temp.path() / "roof.obj";
  std::ofstream(mesh) << "v 0 0 0\nv 1 0 0\nv 0 1 9\nf 1 2 3\n";
  const std::string file = temp.path() / "own.yaml";
  std::ofstream(file) << "structure: {file: {path: roof.obj}}\n"
                         "workspace_m: {min: [-8, -8, 0], max: [8, 8, 6]}\n"
                         "cameras: [{name: front}]\n"
                         "start: {position_m: [0, -5, 2], jitter_m: [0, 0, 0]}\n";
  EXPECT_THAT(fault_of_world(load_scenario(file, {})),
              StartsWith(file + ":2: workspace_m: " + mesh + ": the mesh spans"));
  EXPECT_THAT(fault_of_world(load_scenario(file, {"structure.file.offset_m=[0, 0, 1]"})),
              StartsWith("--set structure.file.offset_m=[0, 0, 1]: structure.file.offset_m: "));
  EXPECT_THAT(fault_of_world(load_scenario(file, {"structure.offset_m=[0, 0, 1]"})),
              StartsWith("--set structure.offset_m=[0, 0, 1]: structure.offset_m: "));
  EXPECT_THAT(fault_of_world(load_scenario(file, {"workspace_m={max: [8, 8, 5]}"})),
              StartsWith("--set workspace_m={max: [8, 8, 5]}: workspace_m: "));
  EXPECT_THAT(fault_of_world(load_scenario(file, {"structure.file.up_axis=x"})),
              StartsWith("--set structure.file.up_axis=x: structure.file.up_axis: "));
  EXPECT_EQ(fault_of_world(load_scenario(file, {"structure.file.scale=0.5"})), "");
}

TEST(WayOut, AStartWithinAClosedHallIsRefusedUnlessTheVehicleFitsThroughAGate) {
  const Scenario scenario = load_scenario("aircraft", {});
  const std::tuple<double, Vec3, std::string> cases[] = {
      {8.0, {0, 0, 4}, "enclosed"},
      {8.0, {0, -12, 4}, ""},
      {0.0, {0, 0, 4}, ""},           // straight
      {4.4, {-5, 5, 4}, ""},          // around the wall's end
      {6.0, {0, 0, 4}, "enclosed"}};  // 2 m wide, for a sphere of 1.5 m
  for (const auto& [wall_to_m, start_m, says] : cases) {
    const std::string fault = fault_of(scenario, hall(wall_to_m), start_m);
    EXPECT_EQ(fault.empty(), says.empty()) << wall_to_m;
    EXPECT_TRUE(test::says(fault, {says}));
  }
  // none is needed where no profile is flown outside; a room within the hall is all there is
  for (const std::vector<std::string>& sets :
       {std::vector<std::string>{"planner.profiling.method=none"},
        {"workspace_m={min: [-7, -7, 0], max: [7, 7, 9]}", "start.position_m=[0, 0, 4]"}}) {
    EXPECT_EQ(fault_of(load_scenario("aircraft", sets), hall(8.0), {0, 0, 4}), "");
  }
}

TEST(WayUp, IsClearOfAllThatIsSolidAndBeginsOnGround) {
  const auto fault = [](const std::vector<std::string>& sets) {
    const Scenario scenario = load_scenario("smoke", sets);
    const World world = world_of(scenario);
    const RayScene scene(world);
    const ViewPose start = start_pose(scenario, scene);
    return test::fault_of([&] { need_way_up(scenario, world, scene, start); });
  };
  const std::string ground = "start.on_ground=true";
  const std::string roof = "obstacles=[{box_m: {min: [-5, -5, 0.9], max: [5, 5, 1.0]}}]";
  const std::string high = "start.position_m=[0, -3, 3.5]";
  EXPECT_EQ(fault({ground, high}), "");
  EXPECT_EQ(fault({roof, high}), "");
  EXPECT_TRUE(test::says(fault({ground, high, roof}), {"start.on_ground", "something solid"}));
  EXPECT_TRUE(test::says(fault({ground, "structure.ground=false"}),
                         {"start.on_ground", "no ground below"}));
}

TEST(ProfileWarning, NamesTheFirstLegThatIsBlocked) {
  const auto warning_of = [](const std::vector<std::string>& sets) {
    const Scenario scenario = load_scenario("smoke", sets);
    const RayScene scene(world_of(scenario));
    return profile_warning(scenario, scene, start_pose(scenario, scene));
  };
  // across the south face of the workspace, which the profile begins with
  const std::string wall = "obstacles=[{box_m: {min: [-4, -4, 0], max: [4, -3.6, 5]}}]";
  EXPECT_EQ(warning_of({}), "");
  EXPECT_NE(warning_of({wall}).find("the profile's leg from ["), std::string::npos);
  EXPECT_EQ(warning_of({wall, "vehicle.kind=ideal"}), "");
  EXPECT_EQ(warning_of({wall, "planner.profiling.method=none"}), "");
}

TEST(Reference, OfNothingToMeasureIsRefused) {
  setenv("GNBV_CACHE", "", 1);
  const Scenario scenario = load_scenario("aircraft", {});
  World low{TriangleMesh{}, true};
  test::add_box(low.structure, {0, 0, 0}, {4, 4, 0.2});  // floor_z_m is 0.3
  World wire{TriangleMesh{}, true};  // too little surface for any voxel to count
  test::add_box(wire.structure, {0, 0, 0.5}, {4e-4, 4e-4, 4});
  World high = low;
  test::add_box(high.structure, {0, 0, 1}, {1, 1, 1});
  for (const World& world : {low, wire}) {
    const RayScene scene(world);
    EXPECT_THROW(reference_of(scenario, world, scene, 2), BadInput);
  }
  const RayScene scene(high);
  EXPECT_FALSE(reference_of(scenario, high, scene, 2).counted[0].empty());
}

TEST(Reference, ASweepThatTheFlightSkewsIsNoisy) {
  const auto noisy = [](const std::string& looks, const std::string& rolling) {
    return is_noisy(
        load_scenario("smoke", {"lidars.0.looks=" + looks, "lidars.0.rolling=" + rolling}));
  };
  EXPECT_TRUE(noisy("flight", "true"));
  EXPECT_FALSE(noisy("flight", "false"));
  EXPECT_FALSE(noisy("views", "true"));  // at a view all beams are of one instant
}

}  // namespace
}  // namespace gnbv
