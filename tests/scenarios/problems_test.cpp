#include "scenarios/problems.hpp"

#include <gmock/gmock.h>

#include "tests/scenarios/scenario_text.hpp"

namespace gnbv {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

TEST(Problems, AreLaidToTheLineOfTheKeyGivenLast) {
  const std::string text = "cameras:\n  - range_min_m: 9\n";
  EXPECT_EQ(complaint(text),
            "s.yaml:2: cameras.0.range_min_m: value '9': cameras.0.range_min_m = 9 has to be below "
            "cameras.0.range_max_m = 8");
  EXPECT_THAT(complaint(text, {"cameras.0.range_max_m=8.5"}),
              StartsWith("--set cameras.0.range_max_m=8.5: cameras.0.range_max_m: value '8.5': "));
  EXPECT_EQ(complaint(text, {"cameras.0.range_max_m=9.5"}), "");
  EXPECT_THAT(complaint(kMinimal + "lidars: [{range_max_m: 5}]", {"lidars.0.range_min_m=6"}),
              StartsWith("--set lidars.0.range_min_m=6: lidars.0.range_min_m: value '6': "));
  EXPECT_THAT(complaint("cameras:\n  - {}\n  - {name: b}\n", {"cameras=[{}, {}]"}),
              StartsWith("--set cameras=[{}, {}]: cameras.1.name: value 'rgbd': "))
      << "the new list knows nothing of the old one's lines";
}

TEST(Problems, OfAKeyThatIsAtFaultItselfAreNotAdded) {
  EXPECT_EQ(complaint("cameras: [{range_min_m: 9, range_max_m: a}]"),
            "s.yaml:1: cameras.0.range_max_m: value 'a': expects a number");
}

TEST(Problems, AWorkspaceIsABoxThatFitsIntoMemory) {
  EXPECT_EQ(complaint(kMinimal + "workspace_m: {min: [0, 0, 20]}"),
            "s.yaml:2: workspace_m.min: value '[0, 0, 20]': min z = 20 has to be below max z = 20");
  EXPECT_THAT(complaint(kMinimal + "planner: {map: {resolution_m: 0.01}}"),
              AllOf(StartsWith("s.yaml:2: planner.map.resolution_m: value '0.01': "),
                    // 4000 x 4000 x 2000 voxels of 21 bytes, and the frames around them
                    HasSubstr("3.2e+10 voxels and 626.6 GiB"), HasSubstr("the budget is 6 GiB")));
  EXPECT_EQ(complaint(kMinimal + "planner: {map: {resolution_m: 0.05}}"), "");
  EXPECT_THAT(complaint(kMinimal + "planner: {map: {resolution_m: 0.001}}\n"
                                   "workspace_m: {min: [40, 0, 0], max: [41, 1, 1]}\n"
                                   "start: {position_m: [40, 0, 1]}"),
              HasSubstr("OctoMap's keys"));
}

TEST(Problems, TheStartLiesInTheNavigationBox) {
  EXPECT_EQ(complaint(kMinimal + "\nstart:\n  position_m: [0, 0, 0.5]"),
            "s.yaml:4: start.position_m: value '[0, 0, 0.5]': the start [0, 0, 0.5] lies outside "
            "the navigation box from [-20, -20, 0.7] to [20, 20, 20]");
  EXPECT_THAT(complaint(kMinimal + "planner: {validity: {z_min_m: 20}}"),
              AllOf(StartsWith("s.yaml:2: planner.validity.z_min_m: value '20': "),
                    HasSubstr("the navigation box is empty")));
}

TEST(Problems, CamerasExistAndDiffer) {
  EXPECT_EQ(complaint("name: a"), "s.yaml: cameras: names no camera; at least one has to look");
  EXPECT_THAT(complaint("cameras: []"), StartsWith("s.yaml:1: cameras: value '[]': has 0 items"));
  EXPECT_EQ(complaint("cameras:\n  - {}\n  - {name: rgbd}\n"),
            "s.yaml:3: cameras.1.name: value 'rgbd': two cameras, 0 and 1, are named 'rgbd'");
}

TEST(Problems, AVoxelCanBecomeFreeAndOccupied) {
  const std::string map = kMinimal + "planner: {map: {";
  EXPECT_THAT(
      complaint(map + "free_max: 0.6}}"),
      HasSubstr("planner.map.free_max = 0.6 has to be below planner.map.occupied_min = 0.6"));
  EXPECT_THAT(complaint(map + "clamp_max: 0.55}}"), HasSubstr("nothing could become occupied"));
  EXPECT_THAT(complaint(map + "clamp_min: 0.45}}"), HasSubstr("nothing could become free"));
}

TEST(Problems, OthersThatCannotRun) {
  EXPECT_THAT(complaint(kMinimal, {"vehicle.airframe.rotors.2.spin=0.5"}),
              HasSubstr("rotors.2.spin: value '0.5': has to be 1 or -1"));
  EXPECT_THAT(complaint(kMinimal, {"vehicle.autopilot.thrust_max=0.1"}), HasSubstr("thrust_min"));
  EXPECT_THAT(complaint(kMinimal, {"vehicle.airframe.rolling_coefficient_n_s2=1"}),
              HasSubstr("allowed: from 0 to 0.0001"));
  EXPECT_THAT(complaint(kMinimal, {"planner.utility={beta: 0, gamma: 0}"}),
              HasSubstr("Eq. (2) divides"));
  EXPECT_THAT(complaint(kMinimal + "structure: {file: {path: none.obj}}"),
              AllOf(StartsWith("s.yaml:2: structure.file.path: value '"),
                    HasSubstr("none.obj': there is no such file")));
}

TEST(Problems, ATourPlansOverSoManyPlaces) {
  EXPECT_THAT(complaint(kMinimal + "planner: {tour: {lattice_step_m: 1e-6}}"),
              AllOf(StartsWith("s.yaml:2: planner.tour.lattice_step_m: value '1.0e-06': "),
                    HasSubstr("4.1e+06 places, one every 0.2 m")));
  EXPECT_EQ(complaint(kMinimal + "planner: {tour: {lattice_step_m: 0.6}}"), "");
}

TEST(Problems, LidarsDiffer) {
  EXPECT_THAT(complaint(kMinimal + "lidars:\n  - {}\n  - {}\n"),
              HasSubstr("lidars.1.name: value 'lidar': two lidars, 0 and 1, are named"));
}

TEST(Problems, RotorsCanSteer) {
  const std::string airframe = "vehicle.airframe.";
  EXPECT_THAT(complaint(kMinimal, {airframe + "moment_per_thrust_m=0"}),
              AllOf(HasSubstr(airframe + "moment_per_thrust_m: value '0'"),
                    HasSubstr("nothing turns the vehicle")));
  EXPECT_THAT(complaint(kMinimal, {airframe + "moment_per_thrust_m=1e-5"}),
              HasSubstr("the rotors turn the vehicle about its vertical by"));
  EXPECT_THAT(complaint(kMinimal, {airframe + "rotors.2.spin=1", airframe + "rotors.3.spin=1"}),
              HasSubstr("cannot give yaw apart from thrust"));
  EXPECT_THAT(complaint(kMinimal, {airframe + "rotors=[{spin: 1}, {spin: 1}, {spin: -1}]"}),
              HasSubstr("has 3 items (allowed: from 4 to 8)"));
  EXPECT_THAT(complaint(kMinimal, {airframe + "rotors=[{}, {}, {}, {}]"}),
              HasSubstr("these rotors cannot give"));
  EXPECT_THAT(complaint(kMinimal, {airframe + "drag_coefficient_n_s2_per_m=1"}),
              HasSubstr("the rotors' drag at full command"));
  EXPECT_EQ(complaint(kMinimal, {airframe + "rotors=[{p_body_m: [0.3, 0, 0], spin: 1}, "
                                            "{p_body_m: [-0.3, 0, 0], spin: 1}, "
                                            "{p_body_m: [0, 0.3, 0], spin: -1}, "
                                            "{p_body_m: [0, -0.3, 0], spin: -1}]"}),
            "");
}

TEST(Problems, TheHullFitsIntoWhatIsKeptFree) {
  EXPECT_THAT(complaint(kMinimal, {"vehicle.airframe.hull_radius_m=1.6"}),
              AllOf(HasSubstr("vehicle.airframe.hull_radius_m: value '1.6'"),
                    HasSubstr("planner.validity.collision_radius_m has to be more")));
  EXPECT_EQ(complaint(kMinimal, {"vehicle.kind=ideal", "vehicle.airframe.hull_radius_m=1.6"}), "");
}

TEST(Problems, NoLegTakesHours) {
  EXPECT_THAT(complaint(kMinimal, {"guidance.yaw_rate_deg_s=0.001"}), HasSubstr("allowed: from"));
  for (const std::string key : {"path_speed_m_s=0.01", "profile_speed_m_s=0.01"}) {
    EXPECT_THAT(complaint(kMinimal, {"guidance." + key}), HasSubstr("leg through the workspace"));
  }
  EXPECT_THAT(complaint(kMinimal, {"vehicle.autopilot.rate_max_deg_s=[1, 1, 0.1]",
                                   "guidance.yaw_rate_deg_s=0.1", "guidance.yaw_jerk_deg_s3=0.1"}),
              testing::Not(HasSubstr("leg through")));
}

TEST(Problems, OfABuiltinScenarioAreNone) {
  for (const std::string& name : builtin_scenario_names()) {
    EXPECT_TRUE(problems(load_scenario(name, {})).empty()) << name;
  }
}

TEST(Problems, AnIdealVehicleDoesNotEstimate) {
  EXPECT_THAT(complaint(kMinimal + "vehicle: {kind: ideal}", {"vehicle.estimate.model=gnss"}),
              StartsWith("--set vehicle.estimate.model=gnss: vehicle.estimate.model: "));
}

TEST(Problems, AWindIsOneTheVehicleCanHoverIn) {
  EXPECT_EQ(complaint(kMinimal + "wind: {mean_m_s: [12, -9, 0], gust_w20_m_s: 15.4}"), "");
  EXPECT_THAT(complaint(kMinimal + "wind: {mean_m_s: [0, 40, 0]}"),
              AllOf(StartsWith("s.yaml:2: wind.mean_m_s: value '[0, 40, 0]': "),
                    HasSubstr("hovering in a wind of 40 m/s takes a tilt of "),
                    HasSubstr("the autopilot allows less than 45 deg")));
  EXPECT_THAT(complaint(kMinimal + "vehicle: {kind: ideal}\nwind: {gust_w20_m_s: 5}"),
              HasSubstr("an ideal vehicle moves exactly as commanded"));
}

TEST(Problems, OnlySatellitesAreLostAndOneOutageAfterAnother) {
  const std::string outages = "outages: [{start_s: 5, duration_s: 10}, {start_s: 20}]";
  EXPECT_EQ(complaint(kMinimal + "vehicle: {estimate: {model: gnss, " + outages + "}}"), "");
  EXPECT_THAT(complaint(kMinimal + "vehicle: {estimate: {model: vio, " + outages + "}}"),
              HasSubstr("only an estimate by satellites, `gnss`, can lose them"));
  EXPECT_THAT(complaint(kMinimal + "vehicle: {estimate: {model: gnss, " + outages + "}}",
                        {"vehicle.estimate.outages.1.start_s=14"}),
              AllOf(StartsWith("--set vehicle.estimate.outages.1.start_s=14: "),
                    HasSubstr("begins before that at 5 s has ended")));
}

}  // namespace
}  // namespace gnbv
