// Who is told of keys without effect, and where they stand.
#include <gtest/gtest.h>

#include "scenarios/load.hpp"
#include "tests/scenarios/scenario_text.hpp"

namespace gnbv {
namespace {

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
