// Who is told of keys without effect, and where they stand.
#include "scenarios/idle_keys.hpp"

#include <gtest/gtest.h>

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

TEST(IdleKeyNotes, NameKeyLineAndReasonInTheOrderOfTheFile) {
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
            "structure.file.scale (s.yaml:7) has no effect: the structure is built in, "
            "'aircraft'; structure.file.path is empty");
}

TEST(IdleKeyNotes, PassOverDefaultsOfAFileAlsoThoseOfItsPreset) {
  EXPECT_TRUE(notes_of(kIsler).empty());
  EXPECT_TRUE(notes_of(kMinimal + "planner: {utility: {name: isler, alpha: 10}}\n").empty());
  const std::string released = "planner: {preset: released, utility: {name: proposed, ";
  EXPECT_TRUE(notes_of(kMinimal + released + "bircher_lambda_per_m: 0.5}}\n").empty());
  EXPECT_EQ(notes_of(kMinimal + released + "bircher_lambda_per_m: 0.2}}\n").size(), 1U);
}

TEST(IdleKeyNotes, PassOverAFileThatGivesEveryKey) {
  const Scenario scenario = load_text(kMinimal + "planner: {routes: {standoff_m: 2}}\n");
  EXPECT_TRUE(notes_of(to_yaml(scenario)).empty());
}

TEST(IdleKeyNotes, PassOverWhatIsBuiltIn) {
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
