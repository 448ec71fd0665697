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
  EXPECT_THAT(complaint("cameras:\n  - return_max_m: 0.3\n"),  // range_min_m is 0.3
              StartsWith("s.yaml:2: cameras.0.return_max_m: value '0.3': "));
  EXPECT_THAT(complaint(kMinimal + "lidars: [{range_max_m: 5}]", {"lidars.0.range_min_m=6"}),
              StartsWith("--set lidars.0.range_min_m=6: lidars.0.range_min_m: value '6': "));
  EXPECT_THAT(complaint("cameras:\n  - {}\n  - {name: b}\n", {"cameras=[{}, {}]"}),
              StartsWith("--set cameras=[{}, {}]: cameras.1.name: value 'rgbd': "))
      << "the new list knows nothing of the old one's lines";
  const std::string below = "start: {position_m: [0, 0, 3]}\nworkspace_m: {max: [9, 9, 2]}\n";
  EXPECT_THAT(complaint(kMinimal + below, {"start.preset=authors_pose_0"}),
              StartsWith("--set start.preset=authors_pose_0: start.position_m: "));
  EXPECT_THAT(complaint("cameras:\n  - {}\n  - {}\n", {"cameras.0.preset=zed_mini"}),
              StartsWith("s.yaml:3: cameras.1.name: "))
      << "a preset sets no name";
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
  EXPECT_THAT(complaint("name: a"), StartsWith("s.yaml: cameras: names no camera"));
  EXPECT_EQ(complaint("cameras: []"), "");  // the LIDARs look
  EXPECT_THAT(complaint("cameras: []\nlidars: []\nplanner: {profiling: {method: none}}\n"),
              StartsWith("s.yaml:1: cameras: names no camera, and lidars no LIDAR"));
  EXPECT_EQ(complaint("cameras:\n  - {}\n  - {name: rgbd}\n"),
            "s.yaml:3: cameras.1.name: value 'rgbd': two cameras, 0 and 1, are named 'rgbd'");
}

struct Fault {
  std::vector<std::string> overrides;
  std::string words;  // of the complaint; empty: none
};

TEST(Problems, OfValuesThatDoNotGoTogether) {
  const std::string a = "vehicle.airframe.";
  for (const auto& [overrides, words] : std::vector<Fault>{
           {{"planner.map.free_max=0.6"},
            "planner.map.free_max = 0.6 has to be below planner.map.occupied_min = 0.6"},
           {{"planner.map.clamp_max=0.55"}, "nothing could become occupied"},
           {{"planner.map.clamp_min=0.45"}, "nothing could become free"},
           {{a + "rotors.2.spin=0.5"}, "rotors.2.spin: value '0.5': has to be 1 or -1"},
           {{"vehicle.autopilot.thrust_max=0.1"}, "thrust_min"},
           {{a + "rolling_coefficient_n_s2=1"}, "allowed: from 0 to 0.0001"},
           {{"planner.utility={beta: 0, gamma: 0}"}, "Eq. (2) divides"},
           {{"planner.cloud.profile_leaf_m=0.002"},
            "planner.cloud.profile_leaf_m: value '0.002': profile_leaf_m = 0.002 has to be at "
            "least"},
           {{"planner.tour.lattice_step_m=1e-6"},
            "planner.tour.lattice_step_m: value '1.0e-06': a lattice of 4.1e+06 places, one every "
            "0.2 m"},
           {{"planner.tour.lattice_step_m=0.6"}, ""},
           {{"lidars=[{}, {}]"}, "lidars.1.name: value 'lidar': two lidars, 0 and 1, are named"},
           // rotors that can steer
           {{a + "moment_per_thrust_m=0"}, "nothing turns the vehicle"},
           {{a + "moment_per_thrust_m=0"}, a + "moment_per_thrust_m: value '0'"},
           {{a + "moment_per_thrust_m=1e-5"}, "the rotors turn the vehicle about its vertical by"},
           {{a + "rotors.2.spin=1", a + "rotors.3.spin=1"}, "cannot give yaw apart from thrust"},
           {{a + "rotors=[{spin: 1}, {spin: 1}, {spin: -1}]"},
            "has 3 items (allowed: from 4 to 8)"},
           {{a + "rotors=[{}, {}, {}, {}]"}, "these rotors cannot give"},
           {{a + "drag_coefficient_n_s2_per_m=1"}, "the rotors' drag at full command"},
           {{a + "rotors=[{p_body_m: [0.3, 0, 0], spin: 1}, {p_body_m: [-0.3, 0, 0], spin: 1}, "
                 "{p_body_m: [0, 0.3, 0], spin: -1}, {p_body_m: [0, -0.3, 0], spin: -1}]"},
            ""},
           {{a + "gravity_m_s2=40"}, a + "gravity_m_s2: value '40': hovering takes the command"},
           {{a + "idle_speed_rad_s=9e3"}, a + "idle_speed_rad_s: value '9000': hovering takes"},
           {{a + "command_gain_rad_s=9"}, a + "command_gain_rad_s: value '9': hovering takes"},
           // a hull that fits into what is kept free
           {{a + "hull_radius_m=1.6"}, a + "hull_radius_m: value '1.6'"},
           {{a + "hull_radius_m=1.6"}, "planner.validity.collision_radius_m has to be more"},
           {{"vehicle.kind=ideal", a + "hull_radius_m=1.6"}, ""},
           // no leg takes hours
           {{"guidance.yaw_rate_deg_s=0.001"}, "allowed: from"},
           {{"guidance.path_speed_m_s=0.01"}, "leg through the workspace"},
           {{"guidance.profile_speed_m_s=0.01"}, "leg through the workspace"},
           // an ideal vehicle does not estimate and feels no wind
           {{"vehicle.kind=ideal", "vehicle.estimate.model=gnss"},
            "--set vehicle.estimate.model=gnss: vehicle.estimate.model: "},
           {{"vehicle.kind=ideal", "wind.gust_w20_m_s=5"},
            "an ideal vehicle moves exactly as commanded"},
           {{"wind={mean_m_s: [12, -9, 0], gust_w20_m_s: 15.4}"}, ""},
           {{"wind.mean_m_s=[0, 40, 0]"}, "hovering in a wind of 40 m/s takes more thrust than"},
           {{"wind.mean_m_s=[0, 40, 0]"}, "the autopilot allows less than 45 deg"},
           // only satellites are lost, and one outage after another
           {{"vehicle.estimate={model: gnss, outages: [{start_s: 5, duration_s: 10}, "
             "{start_s: 20}]}"},
            ""},
           {{"vehicle.estimate={model: vio, outages: [{start_s: 5}]}"},
            "only an estimate by satellites, `gnss` or `rtk`, can lose them"},
           {{"vehicle.estimate={model: gnss, outages: [{start_s: 5, duration_s: 10}, "
             "{start_s: 14}]}"},
            "begins before that at 5 s has ended"}}) {
    const std::string said = complaint(kMinimal, overrides);
    EXPECT_EQ(said.empty(), words.empty()) << said;
    EXPECT_THAT(said, HasSubstr(words));
  }
  EXPECT_THAT(complaint(kMinimal, {"vehicle.autopilot.rate_max_deg_s=[1, 1, 0.1]",
                                   "guidance.yaw_rate_deg_s=0.1", "guidance.yaw_jerk_deg_s3=0.1"}),
              testing::Not(HasSubstr("leg through")));
  EXPECT_THAT(complaint(kMinimal + "structure: {file: {path: none.obj}}"),
              AllOf(StartsWith("s.yaml:2: structure.file.path: value '"),
                    HasSubstr("none.obj': there is no such file")));
}

TEST(ClearingNote, IsOfCamerasWhoseReturnsEndBeforeWhatTheyClear) {
  const auto note_of = [](const std::vector<std::string>& sets) {
    return clearing_note(load_scenario("aircraft", sets));
  };
  EXPECT_EQ(note_of({}), "");
  EXPECT_EQ(note_of({"cameras.0.return_max_m=5", "planner.map.no_return=unknown"}), "");
  EXPECT_EQ(note_of({"cameras.0.return_max_m=8"}), "");
  EXPECT_EQ(note_of({"cameras.1.return_max_m=5"}),
            "rays clear surface that is too deep for a return, as planner.map.no_return is free: "
            "rgbd_up from 5 to 8 m");
  EXPECT_TRUE(note_of({"planner.preset=authors_2018"})
                  .ends_with("rgbd_down from 5 to 8 m, rgbd_up from 5 to 8 m"));
}

}  // namespace
}  // namespace gnbv
