// Files of version 0.1 are read: what was removed since is passed over at its former default.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenarios/load.hpp"
#include "tests/scenarios/scenario_text.hpp"

namespace gnbv {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

/// What loading says on stderr.
std::string said_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  testing::internal::CaptureStderr();
  load_text(text, overrides);
  return testing::internal::GetCapturedStderr();
}

TEST(OldKeys, AtTheirFormerDefaultsAreOneLineOnStderr) {
  const std::string said = said_of(kMinimal +
                                   "vehicle:\n"
                                   "  autopilot:\n"
                                   "    commander: {spool_up_s: 1, jerk_m_s3: 4.0,\n"
                                   "      offboard_loss_action: position, land_speed_m_s: 0.7}\n");
  EXPECT_THAT(said, AllOf(HasSubstr("s.yaml: "),
                          HasSubstr("vehicle.autopilot.commander.spool_up_s and 3 more: ")));
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1);
  EXPECT_EQ(said_of(kMinimal), "");
  EXPECT_THAT(said_of(kMinimal, {"vehicle.autopilot.commander.spool_up_s=1"}),
              HasSubstr("--set vehicle.autopilot.commander.spool_up_s=1: "));
}

TEST(OldKeys, LeaveTheConfigurationOfAFileWhatItIs) {
  const ScenarioFile file(kMinimal + "vehicle: {autopilot: {commander: {spool_up_s: 1}}}\n");
  const Scenario scenario = load_text(kMinimal);
  EXPECT_TRUE(is_written_in(file.path().string(), scenario));
  EXPECT_FALSE(is_written_in(file.path().string(), load_text(kMinimal, {"seed=2"})));
  EXPECT_FALSE(is_written_in(ScenarioFile("nonsense").path().string(), scenario));
}

TEST(OldKeys, WithAnyOtherValueAreRefusedByNameAsAreUnknownOnesBesideThem) {
  const auto commander = [](const std::string& preset, const std::string& keys) {
    return complaint(fmt::format("{}vehicle:\n  {{preset: {}, autopilot: {{commander: {{{}}}}}}}\n",
                                 kMinimal, preset, keys));
  };
  EXPECT_EQ(commander("iris", "spool_up_s: 2"),
            "s.yaml:3: vehicle.autopilot.commander.spool_up_s: value '2': the key was removed "
            "after version 0.1; only its former default, 1, is still read");
  EXPECT_THAT(complaint(kMinimal, {"vehicle.autopilot.commander={spool_up_s: 3}"}),
              HasSubstr("vehicle.autopilot.commander.spool_up_s: value '3': "));
  // the default is what the vehicle's preset had
  EXPECT_EQ(commander("iris_sitl_2019",
                      "offboard_loss_s: 0.5, offboard_loss_action: rtl, offboard_loss_hold_s: 5"),
            "");
  EXPECT_THAT(commander("iris_sitl_2019", "offboard_loss_hold_s: 1"),
              HasSubstr("only its former default, 5, is still read"));
  EXPECT_EQ(commander("authors", "tilt_max_on_ground_deg: 15"), "");
  EXPECT_THAT(commander("iris", "offboard_los_s: 1"),
              HasSubstr("vehicle.autopilot.commander.offboard_los_s: is no known key"));
}

// `cameras.N.pitch_deg`: a number, or a gimbal's min, max and step.

const std::string kGimbal = "cameras: [{pitch_deg: {min: -12.3, max: 50, step: 15}}]\n";

TEST(GimbalKeys, ANumberIsAFixedMountingAndAMapAGimbal) {
  const CameraConfig fixed = load_text("cameras: [{pitch_deg: 12.3}]").cameras[0];
  EXPECT_EQ(fixed.pitch_rad, deg_to_rad(12.3));
  EXPECT_FALSE(fixed.gimbal);
  const CameraConfig turning = load_text(kGimbal).cameras[0];
  ASSERT_TRUE(turning.gimbal);
  EXPECT_EQ(turning.gimbal->min_rad, deg_to_rad(-12.3));
  EXPECT_EQ(turning.gimbal->max_rad, deg_to_rad(50.0));
  EXPECT_EQ(turning.gimbal->step_rad, deg_to_rad(15.0));
  EXPECT_EQ(turning.pitch_rad, pitches_rad(*turning.gimbal)[1]);  // 2.7 degrees: the most level
}

TEST(GimbalKeys, WrittenAndReadBackAreTheSameAndOneReplacesTheOther) {
  const Scenario fixed = load_text("cameras: [{pitch_deg: 12.3}]\n"), turning = load_text(kGimbal);
  EXPECT_TRUE(repeats(fixed) && repeats(turning));
  EXPECT_THAT(to_yaml(fixed), HasSubstr("    pitch_deg: 12.3\n"));
  EXPECT_THAT(to_yaml(turning),
              HasSubstr("    pitch_deg:\n      min: -12.3\n      max: 50\n      step: 15\n"));
  const auto gimbal = [](const std::string& text, const std::string& set) {
    return load_text(text, {set}).cameras[0].gimbal;
  };
  EXPECT_FALSE(gimbal(kGimbal, "cameras.0.pitch_deg=20"));
  EXPECT_EQ(gimbal("cameras: [{pitch_deg: 20}]", "cameras.0.pitch_deg={max: 40}")->max_rad,
            deg_to_rad(40.0));
  EXPECT_EQ(gimbal(kGimbal, "cameras.0.pitch_deg.step=10")->step_rad, deg_to_rad(10.0));
  // a preset of the sensor leaves its mounting alone
  EXPECT_TRUE(gimbal(kGimbal, "cameras.0.preset=zed_mini"));
}

TEST(GimbalKeys, WrongOnesAreRefusedInOneLine) {
  EXPECT_THAT(complaint("cameras: [{pitch_deg: {min: 30, max: 20}}]"),
              StartsWith("s.yaml:1: cameras.0.pitch_deg.max: value '20': cameras.0.pitch_deg.min = "
                         "30 has to be below cameras.0.pitch_deg.max = 20"));
  EXPECT_THAT(complaint("cameras: [{pitch_deg: {min: -91}}]"), HasSubstr("pitch_deg.min"));
  EXPECT_THAT(complaint("cameras: [{pitch_deg: {step: 0}}]"), HasSubstr("pitch_deg.step"));
  EXPECT_THAT(complaint("cameras: [{pitch_deg: {mni: 0}}]"), HasSubstr("did you mean"));
  EXPECT_THAT(complaint("cameras: [{pitch_deg: up}]"), HasSubstr("expects a number"));
  EXPECT_THAT(
      complaint("cameras: [{name: a, pitch_deg: {max: 20}}, {name: b, pitch_deg: {max: 30}}]"),
      HasSubstr("hang on one gimbal"));
  EXPECT_EQ(complaint("cameras: [{name: a, pitch_deg: {max: 20}}, {name: b, pitch_deg: {max: 20}}, "
                      "{name: c, pitch_deg: 5}]"),
            "");
}

// Who is told of keys without effect, and where they stand.

std::vector<std::string> notes_of(const std::string& text) {
  const ScenarioFile file(text);
  std::vector<std::string> notes;
  load_with_overrides(file.path().string(), {}, {}, &notes);
  for (std::string& note : notes) note = file.folder().without_path(note);
  return notes;
}

TEST(UnusedParameterNotes, NameKeyLineAndReasonInTheOrderOfTheFile) {
  const auto notes = notes_of(kMinimal +
                              "planner:\n"
                              "  routes: {standoff_m: 2}\n"
                              "  utility:\n"
                              "    alpha: 3\n"
                              "    name: isler\n"
                              "structure: {file: {scale: 2}}\n");
  EXPECT_THAT(
      notes,
      testing::ElementsAre(
          "planner.routes.standoff_m (s.yaml:3) has no effect: planner.utility.name is isler",
          "planner.utility.alpha (s.yaml:5) has no effect: planner.utility.name is isler",
          "structure.file.scale (s.yaml:7) has no effect: structure.file.path is empty"));
}

TEST(UnusedParameterNotes, PassOverDefaultsOfAFileAlsoThoseOfItsPresetAndAFileThatGivesEveryKey) {
  EXPECT_TRUE(notes_of(kMinimal + "planner: {utility: {name: isler, alpha: 10}}\n").empty());
  const std::string released = "planner: {preset: released, utility: {name: proposed, ";
  EXPECT_TRUE(notes_of(kMinimal + released + "bircher_lambda_per_m: 0.5}}\n").empty());
  EXPECT_EQ(notes_of(kMinimal + released + "bircher_lambda_per_m: 0.2}}\n").size(), 1U);
  const Scenario scenario = load_text(kMinimal + "planner: {routes: {standoff_m: 2}}\n");
  EXPECT_TRUE(notes_of(to_yaml(scenario)).empty());
}

TEST(UnusedParameterNotes, AreOfAllThatTheUtilityAndTheBatteryDoNotRead) {
  for (const auto& [text, note] : std::vector<std::pair<std::string, std::string>>{
           {"planner: {utility: {legacy_visibility: true}}",
            "planner.utility.legacy_visibility (s.yaml:2) has no effect: planner.utility.name is "
            "proposed"},
           {"planner: {utility: {name: isler}, symmetry: {enabled: false}}",
            "planner.symmetry.enabled (s.yaml:2) has no effect: planner.utility.name is isler"},
           {"planner: {utility: {gamma: 0}, symmetry: {min_support: 0.1}}",
            "planner.symmetry.min_support (s.yaml:2) has no effect: planner.utility.gamma is 0"},
           {"vehicle: {power: {battery_wh: 9, reserve_share: 0.3}}",
            "vehicle.power.reserve_share (s.yaml:2) has no effect: vehicle.power.return_home is "
            "false"},
           {"planner: {profiling: {method: none}, cloud: {profile_leaf_m: 0.3}}",
            "planner.cloud.profile_leaf_m (s.yaml:2) has no effect: planner.profiling.method is "
            "none"},
           {"planner: {profiling: {method: none}}\nlidars: [{range_max_m: 2}]",
            "lidars.0.range_max_m (s.yaml:3) has no effect: planner.profiling.method is none"},
           {"planner: {profiling: {method: none, flight_rate_hz: 5}}\nlidars: []",
            "planner.profiling.flight_rate_hz (s.yaml:2) has no effect: lidars is empty"},
           {"planner: {utility: {name: tour}, tour: {seconds_per_view: 30}}",
            "planner.tour.seconds_per_view (s.yaml:2) has no effect: planner.tour.cost is metres"},
           {"planner: {fvs: {mode: single}, termination: {within_plans: false}}",
            "planner.termination.within_plans (s.yaml:2) has no effect: planner.fvs.mode is "
            "single"},
           {"vehicle: {estimate: {outage_drift_m_per_sqrt_s: 2}}",
            "vehicle.estimate.outage_drift_m_per_sqrt_s (s.yaml:2) has no effect: "
            "vehicle.estimate.outages is empty"}}) {
    EXPECT_EQ(notes_of(kMinimal + text + '\n'), std::vector{note});
  }
  EXPECT_EQ(notes_of("cameras: [{noise: {baseline_m: 0.1}}]\n"),
            std::vector<std::string>{"cameras.0.noise.baseline_m (s.yaml:1) has no effect: "
                                     "cameras.0.noise.model is none"});
  EXPECT_TRUE(notes_of(kMinimal +
                       "planner: {utility: {name: unobserved_voxel, legacy_visibility: true}}\n"
                       "vehicle: {power: {battery_wh: 9, return_home: true, reserve_share: 0.3}}\n")
                  .empty());
}

TEST(UnusedParameterNotes, PassOverWhatIsBuiltIn) {
  for (const std::string& name : builtin_scenario_names()) {
    for (const char* utility : {"isler", "bircher", "lawnmower", "oracle_views"}) {
      std::vector<std::string> notes;
      load_with_overrides(name, {{.text = fmt::format("planner.utility.name={}", utility)}}, {},
                          &notes);
      EXPECT_TRUE(notes.empty()) << name << ' ' << notes.size();
    }
  }
}

}  // namespace
}  // namespace gnbv
