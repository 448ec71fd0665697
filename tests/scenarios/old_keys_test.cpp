// Files of version 0.1 are read: what was removed since is passed over at its former default.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenarios/load.hpp"
#include "tests/scenarios/scenario_text.hpp"

namespace gnbv {
namespace {

using testing::AllOf;
using testing::HasSubstr;

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
                                   "    commander: {offboard_loss_s: 1, jerk_m_s3: 4.0,\n"
                                   "      offboard_loss_action: position, land_speed_m_s: 0.7}\n");
  EXPECT_THAT(said, AllOf(HasSubstr("s.yaml: "),
                          HasSubstr("vehicle.autopilot.commander.offboard_loss_s and 3 more: ")));
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

TEST(OldKeys, WithAnyOtherValueAreRefusedByName) {
  EXPECT_EQ(complaint(kMinimal + "vehicle:\n  autopilot: {commander: {offboard_loss_s: 2}}\n"),
            "s.yaml:3: vehicle.autopilot.commander.offboard_loss_s: value '2': the key was removed "
            "after version 0.1; only its former default, 1, is still read");
  EXPECT_THAT(complaint(kMinimal, {"vehicle.autopilot.commander={spool_up_s: 3}"}),
              HasSubstr("vehicle.autopilot.commander.spool_up_s: value '3': "));
}

TEST(OldKeys, OfTheCommanderAreWhatTheVehiclesPresetHad) {
  const std::string kPx19 =
      "vehicle: {preset: iris_sitl_2019, autopilot: {commander: {offboard_loss_s: 0.5, "
      "offboard_loss_action: rtl, offboard_loss_hold_s: 5}}}\n";
  EXPECT_EQ(complaint(kMinimal + kPx19), "");
  EXPECT_THAT(complaint(kMinimal + "vehicle: {preset: iris_sitl_2019, autopilot: {commander: "
                                   "{offboard_loss_s: 1}}}\n"),
              HasSubstr("only its former default, 0.5, is still read"));
  EXPECT_EQ(complaint(kMinimal + "vehicle: {preset: authors, autopilot: {commander: "
                                 "{tilt_max_on_ground_deg: 15}}}\n"),
            "");
}

TEST(OldKeys, AreNoSectionOfUnknownKeys) {
  EXPECT_THAT(complaint(kMinimal + "vehicle: {autopilot: {commander: {offboard_los_s: 1}}}\n"),
              HasSubstr("vehicle.autopilot.commander.offboard_los_s: is no known key"));
}

// `cameras.N.pitch_deg`: a number, or a gimbal's min, max and step.

using testing::HasSubstr;
using testing::StartsWith;

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

TEST(GimbalKeys, WrittenAndReadBackAreTheSame) {
  for (const std::string& text : {kGimbal, std::string("cameras: [{pitch_deg: 12.3}]\n")}) {
    const std::string yaml = to_yaml(load_text(text));
    EXPECT_EQ(to_yaml(load_text(yaml)), yaml);
  }
  EXPECT_THAT(to_yaml(load_text("cameras: [{pitch_deg: 12.3}]")),
              HasSubstr("    pitch_deg: 12.3\n"));
  EXPECT_THAT(to_yaml(load_text(kGimbal)),
              HasSubstr("    pitch_deg:\n      min: -12.3\n      max: 50\n      step: 15\n"));
}

TEST(GimbalKeys, OneReplacesTheOther) {
  EXPECT_FALSE(load_text(kGimbal, {"cameras.0.pitch_deg=20"}).cameras[0].gimbal);
  const auto gimbal =
      load_text("cameras: [{pitch_deg: 20}]", {"cameras.0.pitch_deg={max: 40}"}).cameras[0].gimbal;
  ASSERT_TRUE(gimbal);
  EXPECT_EQ(gimbal->max_rad, deg_to_rad(40.0));
  EXPECT_EQ(load_text(kGimbal, {"cameras.0.pitch_deg.step=10"}).cameras[0].gimbal->step_rad,
            deg_to_rad(10.0));
  // a preset of the sensor leaves its mounting alone
  EXPECT_TRUE(load_text(kGimbal, {"cameras.0.preset=zed_mini"}).cameras[0].gimbal);
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
  for (std::string& note : notes) {
    const std::size_t at = note.find(file.folder().string());
    if (at != std::string::npos) note.erase(at, file.folder().string().size() + 1);
  }
  return notes;
}

const std::string kIsler = kMinimal + "planner:\n  utility: {name: isler}\n";

TEST(UnusedParameterNotes, NameKeyLineAndReasonInTheOrderOfTheFile) {
  const auto notes = notes_of(kMinimal +
                              "planner:\n"
                              "  routes: {standoff_m: 2}\n"
                              "  utility:\n"
                              "    alpha: 3\n"
                              "    name: isler\n"
                              "structure: {file: {scale: 2}}\n");
  ASSERT_EQ(notes.size(), 3U);
  EXPECT_EQ(notes[0],
            "planner.routes.standoff_m (s.yaml:3) has no effect: planner.utility.name is isler");
  EXPECT_EQ(notes[1],
            "planner.utility.alpha (s.yaml:5) has no effect: planner.utility.name is isler");
  EXPECT_EQ(notes[2],
            "structure.file.scale (s.yaml:7) has no effect: structure.file.path is empty");
}

TEST(UnusedParameterNotes, PassOverDefaultsOfAFileAlsoThoseOfItsPreset) {
  EXPECT_TRUE(notes_of(kIsler).empty());
  EXPECT_TRUE(notes_of(kMinimal + "planner: {utility: {name: isler, alpha: 10}}\n").empty());
  const std::string released = "planner: {preset: released, utility: {name: proposed, ";
  EXPECT_TRUE(notes_of(kMinimal + released + "bircher_lambda_per_m: 0.5}}\n").empty());
  EXPECT_EQ(notes_of(kMinimal + released + "bircher_lambda_per_m: 0.2}}\n").size(), 1U);
}

TEST(UnusedParameterNotes, PassOverAFileThatGivesEveryKey) {
  const Scenario scenario = load_text(kMinimal + "planner: {routes: {standoff_m: 2}}\n");
  EXPECT_TRUE(notes_of(to_yaml(scenario)).empty());
}

TEST(UnusedParameterNotes, AreOfAllThatTheUtilityAndTheBatteryDoNotRead) {
  const auto only_note = [](const std::string& text) {
    const auto notes = notes_of(text);
    return notes.size() == 1 ? notes[0] : fmt::format("{} notes", notes.size());
  };
  EXPECT_EQ(only_note(kMinimal + "planner: {utility: {legacy_visibility: true}}\n"),
            "planner.utility.legacy_visibility (s.yaml:2) has no effect: planner.utility.name is "
            "proposed");
  EXPECT_EQ(only_note(kMinimal + "planner: {utility: {name: isler}, symmetry: {enabled: false}}\n"),
            "planner.symmetry.enabled (s.yaml:2) has no effect: planner.utility.name is isler");
  EXPECT_EQ(only_note(kMinimal + "planner: {utility: {gamma: 0}, symmetry: {min_support: 0.1}}\n"),
            "planner.symmetry.min_support (s.yaml:2) has no effect: planner.utility.gamma is 0");
  EXPECT_EQ(only_note(kMinimal + "vehicle: {power: {battery_wh: 9, reserve_share: 0.3}}\n"),
            "vehicle.power.reserve_share (s.yaml:2) has no effect: vehicle.power.return_home is "
            "false");
  EXPECT_EQ(only_note("cameras: [{noise: {baseline_m: 0.1}}]\n"),
            "cameras.0.noise.baseline_m (s.yaml:1) has no effect: cameras.0.noise.model is none");
  const std::string read_by_them =
      "planner: {utility: {name: unobserved_voxel, legacy_visibility: true}}\n"
      "vehicle: {power: {battery_wh: 9, return_home: true, reserve_share: 0.3}}\n";
  EXPECT_TRUE(notes_of(kMinimal + read_by_them).empty());
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
