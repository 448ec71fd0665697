#include "scenarios/validation_error.hpp"

#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <functional>

#include "tests/scenarios/scenario_text.hpp"
#include "tests/support/fault.hpp"

namespace gnbv {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

TEST(ValidationErrors, AnUnknownKeyNamesTheNearestTheOneInItsRightPlaceOrAllKnownOnes) {
  for (const auto& [text, said] :
       {std::pair("planner:\n  utilty: {name: isler}\n",
                  "s.yaml:3: planner.utilty: is no known key (did you mean 'planner.utility'?)"),
        std::pair("planner: {agvs: {stepm: 2}}\n",
                  "s.yaml:2: planner.agvs.stepm: is no known key (did you mean "
                  "'planner.agvs.step_m'?)"),
        std::pair("resolution_m: 0.1\n",
                  "s.yaml:2: resolution_m: is no known key (did you mean "
                  "'planner.map.resolution_m'?)"),
        std::pair("planner: {cloud: {xyzzy: 1}}\n",
                  "s.yaml:2: planner.cloud.xyzzy: is no known key (known here: leaf_m, "
                  "profile_leaf_m)")}) {
    EXPECT_EQ(complaint(kMinimal + text), said);
  }
  EXPECT_THAT(complaint(kMinimal + "planner.floor_z_m: 1\n"), HasSubstr("nest them in the file"));
}

TEST(ValidationErrors, AnUnknownNameShowsTheAllowedOnesAndTheNearest) {
  EXPECT_EQ(complaint(kMinimal + "structure: {builtin: aircraf}"),
            "s.yaml:2: structure.builtin: value 'aircraf': is no known name (did you mean "
            "'aircraft'? allowed: aircraft, power_plant, lab_model, lab_airplane, smoke)");
  EXPECT_THAT(complaint(kMinimal + "planner: {utility: {name: islr}}"),
              AllOf(HasSubstr("did you mean 'isler'?"), HasSubstr("proposed")));
  EXPECT_THAT(complaint(kMinimal + "vehicle: {kind: 0}"),
              AllOf(HasSubstr("s.yaml:2: vehicle.kind: value '0'"), HasSubstr("quadrotor, ideal")));
}

TEST(ValidationErrors, AreAllReportedAtOnceInTheOrderOfTheInput) {
  EXPECT_EQ(
      complaint("nme: x\nseed: -1\ncameras:\n  - width_px: a\n  - {name: b, pitch_deg: 91}\n"
                "lidars: [{range_min_m: 30}]\n",
                {"lidars.0.beams=0", "start.yaw=3"}),
      "s.yaml:1: nme: is no known key (did you mean 'name'?)\n"
      "s.yaml:2: seed: value '-1': is out of range (allowed: from 0 to "
      "18446744073709551615)\n"
      "s.yaml:4: cameras.0.width_px: value 'a': expects a whole number\n"
      "s.yaml:5: cameras.1.pitch_deg: value '91': is out of range (allowed: from -90 to 90)\n"
      "s.yaml:6: lidars.0.range_min_m: value '30': lidars.0.range_min_m = 30 has to be below "
      "lidars.0.range_max_m = 30\n"
      "--set lidars.0.beams=0: lidars.0.beams: value '0': is out of range (allowed: from 1 to "
      "100000)\n"
      "--set start.yaw=3: start.yaw: is no known key (did you mean "
      "'start.yaw_deg'?)");
}

TEST(ExactTypes, WholeNumbersTakeNothingElse) {
  for (const char* bad : {"1.5", "5.0", "1e3", "0x10", "010", "\"5\"", "'5'", "five", "true", "[5]",
                          "{}", "~", "", "99999999999999999999", ".nan", "5 m", "1_000"}) {
    EXPECT_THAT(complaint(fmt::format("{}lidars:\n  - beams: {}\n", kMinimal, bad)),
                StartsWith("s.yaml:3: lidars.0.beams: "))
        << bad;
  }
  EXPECT_EQ(load_text(kMinimal + "lidars: [{beams: +5}]").lidars[0].beams, 5);
}

TEST(ExactTypes, NumbersAreFiniteAndUnquoted) {
  for (const char* bad : {"\"5\"",    "'5'",   ".nan",   ".NaN", "nan", ".inf", "-.inf", "inf",
                          "infinity", "1e999", "1e-999", "five", "5m",  "0x10", "1,5",   "true",
                          "~",        "",      "[5]",    "+-5",  "--5", "."}) {
    EXPECT_THAT(complaint(fmt::format("{}guidance:\n  path_speed_m_s: {}\n", kMinimal, bad)),
                StartsWith("s.yaml:3: guidance.path_speed_m_s: "))
        << bad;
  }
  for (const char* good : {"5", "5.", "5.0", "+5", "0.5e1", "50E-1", "005"}) {
    EXPECT_EQ(load_text(fmt::format("{}guidance: {{path_speed_m_s: {}}}", kMinimal, good))
                  .guidance.path_speed_m_s,
              5.0)
        << good;
  }
  EXPECT_THAT(complaint(kMinimal, {"guidance.pass_yaw_deg=5e-324"}), HasSubstr("out of range"))
      << "in radians it is 0, which its file could not hold";
}

TEST(ExactTypes, FlagsAreTrueOrFalse) {
  for (const char* bad : {"yes", "on", "1", "True", "\"true\"", "~"}) {
    EXPECT_THAT(complaint(fmt::format("{}structure: {{ground: {}}}", kMinimal, bad)),
                AllOf(StartsWith("s.yaml:2: structure.ground: "), HasSubstr("true or false")))
        << bad;
  }
  EXPECT_FALSE(load_text(kMinimal + "structure: {ground: false}").structure.ground);
}

TEST(ExactTypes, TextIsTextNotWhatYamlTakesForANumber) {
  for (const char* bad : {"5", "1e3", "true", "~", "null", "[a]", "a/b", "\"\"", ".hidden"}) {
    EXPECT_THAT(complaint(fmt::format("{}name: {}", kMinimal, bad)), StartsWith("s.yaml:2: name: "))
        << bad;
  }
  EXPECT_EQ(load_text(kMinimal + "name: \"5\"").name, "5");
  EXPECT_EQ(complaint(kMinimal + "name: " + std::string(100, 'a')), "");
  EXPECT_THAT(complaint(kMinimal + "name: " + std::string(101, 'a')), HasSubstr("up to 100"));
}

TEST(ExactTypes, VectorsHaveThreeNumbersAndBoxesTwoCorners) {
  EXPECT_EQ(complaint(kMinimal + "start: {position_m: [0, 0]}"),
            "s.yaml:2: start.position_m: value '[0, 0]': has 2 items; expects [x, y, z]");
  EXPECT_EQ(complaint(kMinimal + "start: {position_m:\n  [0, \"0\", 1]}"),
            "s.yaml:3: start.position_m.1: value '\"0\"': is text in quotes; expects a number");
  EXPECT_THAT(complaint(kMinimal + "workspace_m: [0, 0, 0, 1, 1, 1]"),
              StartsWith("s.yaml:2: workspace_m: value '[0, 0, 0, 1, 1, 1]': expects a map"));
}

TEST(Syntax, FaultsAndRepeatedKeysNameTheirLine) {
  EXPECT_THAT(complaint("name: a\nseed: [1\n"), StartsWith("s.yaml:3: not YAML: "));
  EXPECT_THAT(complaint("name: a\n\tseed: 1\n"), StartsWith("s.yaml:2: not YAML: "));
  EXPECT_EQ(complaint(kMinimal + "lidars:\n  - beams: 5\n    beams: 6\n"),
            "s.yaml:4: lidars.0.beams: key given twice, first on line 3");
  EXPECT_EQ(complaint(kMinimal + "name: !!str a\n"),
            "s.yaml:2: name: the tag 'tag:yaml.org,2002:str' is not supported");
}

TEST(Syntax, AScenarioIsOneMap) {
  EXPECT_EQ(complaint(""), "s.yaml:1: is empty; a scenario is a map of keys");
  EXPECT_EQ(complaint("# nothing\n"), "s.yaml:1: is empty; a scenario is a map of keys");
  EXPECT_EQ(complaint("---\n"), "s.yaml:2: has no value; expects a map of keys");
  EXPECT_EQ(complaint("- 5\n"), "s.yaml:1: value '[5]': expects a map of keys");
  EXPECT_EQ(complaint("5\n"), "s.yaml:1: value '5': expects a map of keys");
  EXPECT_EQ(complaint(kMinimal + "---\nname: a\n"),
            "s.yaml:2: a second YAML document begins here; a scenario is one document");
  EXPECT_EQ(complaint("---\n" + kMinimal + "...\n"), "");
}

TEST(Syntax, AliasesRepeatTheirValueButCannotExplode) {
  EXPECT_EQ(load_text("cameras: [&a {name: a, width_px: 7}, {name: b, width_px: 8}]\n"
                      "start: {position_m: &p [1, 2, 3], jitter_m: *p}")
                .start.jitter_m,
            Vec3(1, 2, 3));
  std::string bomb = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 20; ++i) {
    bomb += fmt::format("a{0}: &a{0} [*a{1}, *a{1}, *a{1}, *a{1}, *a{1}, *a{1}]\n", i, i - 1);
  }
  EXPECT_THAT(complaint(bomb), HasSubstr("aliases stand for more than"));
}

TEST(Syntax, AnchorsWithinAnchorsCannotExplode) {
  // a copy of all below at each of 450 levels of 90 values would be 9 million
  std::string nested;
  for (int i = 0; i < 450; ++i) {
    nested += fmt::format("&a{} [", i);
    for (int k = 0; k < 90; ++k) nested += "0,";
  }
  nested += std::string(450, ']');
  EXPECT_THAT(complaint("name: " + nested), HasSubstr("name: value '[0, 0, "));
  EXPECT_THAT(complaint("name: &a [*a]"),
              HasSubstr("s.yaml:1: name.0: the alias stands inside the value it refers to"));
}

TEST(Overrides, AreRefusedWithTheirText) {
  EXPECT_EQ(complaint(kMinimal, {"planner.utilty.name=x"}),
            "--set planner.utilty.name=x: planner.utilty: is no known key (did you mean "
            "'planner.utility'?)");
  EXPECT_THAT(complaint(kMinimal, {"seed"}), StartsWith("--set seed: has to read key=value"));
  EXPECT_THAT(complaint(kMinimal, {"=5"}), StartsWith("--set =5: has to read key=value"));
  for (const std::string number : {".inf", "-.INF", ".nan", "nan", "inf"}) {
    EXPECT_THAT(complaint(kMinimal, {"planner.floor_z_m=" + number}),
                HasSubstr("expects a finite number"));
  }
  for (const char* nothing : {"seed=", "seed=#1"}) {
    EXPECT_THAT(complaint(kMinimal, {nothing}), HasSubstr(": seed: has no value"));
  }
  EXPECT_NE(complaint(kMinimal, {"seed=,"}), "");  // yaml-cpp sees documents without end
  EXPECT_THAT(complaint(kMinimal, {"seed=[1"}), StartsWith("--set seed=[1: not YAML: "));
  EXPECT_THAT(complaint(kMinimal, {"seed.x=1"}), StartsWith("--set seed.x=1: seed: "));
  EXPECT_THAT(complaint(kMinimal, {".seed=1"}), StartsWith("--set .seed=1: is no known key ("));
  EXPECT_EQ(complaint(kMinimal, {"cameras.1.name=b"}),
            "--set cameras.1.name=b: cameras.1: is no item of the list (allowed: 0 to 0)");
  EXPECT_EQ(complaint(kMinimal, {"start.position_m.3=1"}),
            "--set start.position_m.3=1: start.position_m.3: value '1': is no item of [x, y, z] "
            "(allowed: 0 to 2)");
}

TEST(MissingScenario, ListsTheBuiltinsAndTheNearest) {
  const auto message = [](const std::string& name) {
    return test::fault_of([&] { load_scenario(name, {}); });
  };
  EXPECT_EQ(message("aircaft"),
            fmt::format("aircaft: no such file, and no built-in scenario (did you mean 'aircraft'? "
                        "built in: {})",
                        fmt::join(builtin_scenario_names(), ", ")));
  EXPECT_THAT(message("/nowhere/zzzzzz.yaml"),
              AllOf(HasSubstr("no such file"), HasSubstr("smoke")));
  EXPECT_THAT(message(testing::TempDir()), HasSubstr("is a folder"));
}

TEST(EditDistance, EqualsTheRecursiveDefinition) {
  const std::vector<std::string> words = {"", "a", "ab", "ba", "abc", "acb", "kitten", "sitting"};
  const std::function<std::size_t(std::string_view, std::string_view)> slow =
      [&](std::string_view a, std::string_view b) -> std::size_t {
    if (a.empty() || b.empty()) return a.size() + b.size();
    return std::min({slow(a.substr(1), b) + 1, slow(a, b.substr(1)) + 1,
                     slow(a.substr(1), b.substr(1)) + (a[0] == b[0] ? 0 : 1)});
  };
  for (const std::string& a : words) {
    for (const std::string& b : words) EXPECT_EQ(edit_distance(a, b), slow(a, b)) << a << ' ' << b;
  }
}

}  // namespace
}  // namespace gnbv
