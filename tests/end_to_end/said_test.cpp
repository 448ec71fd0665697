// What the program says beside its results: doubts about a mission, meshes in a row, a run's limit.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "tests/support/program.hpp"
#include "tests/support/temp_folder.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

TEST(Said, RunRepeatsWhatLintWarnsOfAndNoMore) {
  TempFolder temp;
  const std::string mesh = (temp.path() / "low.obj").string();
  ASSERT_EQ(gnbv("asset smoke -o " + mesh).exit_code, 0);
  const std::string run = "run smoke --quiet --set planner.termination.max_iterations=1 --mesh " +
                          mesh + " --out " + temp.path().string();
  const Outcome sound = gnbv(run + "/sound");
  EXPECT_EQ(sound.exit_code, 0) << sound.output;
  EXPECT_FALSE(has(sound, "low.obj: ")) << sound.output;
  const std::string sunk =
      " --set structure.file.offset_m=[0,0,-0.9] --set workspace_m.min=[-4,-4,-1]";
  const Outcome lint = gnbv("lint " + mesh + " --scenario smoke" + sunk);
  ASSERT_TRUE(has(lint, "below the ground")) << lint.output;
  const Outcome warned = gnbv(run + "/sunk" + sunk);
  EXPECT_EQ(warned.exit_code, 0) << warned.output;
  EXPECT_TRUE(has(warned, "low.obj: ground: reaches 0.888 m below the ground")) << warned.output;
  EXPECT_EQ(count_of(warned.output, "low.obj: "), count_of(lint.output, "\nwarning"))
      << warned.output;
}

TEST(Said, RunNamesAKeyWithoutEffectAndFlies) {
  TempFolder temp;
  const Outcome run = gnbv(
      "run smoke --quiet --set planner.termination.max_iterations=1 --set "
      "structure.file.scale=2 --out " +
      (temp.path() / "run").string());
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_TRUE(has(run, "gnbv: structure.file.scale (--set structure.file.scale=2) has no effect: "))
      << run.output;
  const Outcome again = gnbv("run " + (temp.path() / "run/scenario.yaml").string() +
                             " --quiet --out " + (temp.path() / "again").string());
  EXPECT_FALSE(has(again, "no effect")) << again.output;
}

TEST(Said, LintTakesSeveralMeshesAndEndsAsTheWorst) {
  TempFolder temp;
  const std::string good = (temp.path() / "good.obj").string();
  const std::string bad = (temp.path() / "nan.obj").string();
  ASSERT_EQ(gnbv("asset smoke -o " + good).exit_code, 0);
  std::ofstream(bad) << "v 0 0 1\nv nan 0 1\nv 0 1 1\nf 1 2 3\n";
  const Outcome one = gnbv("lint " + good);
  const Outcome both = gnbv("lint " + good + " " + good);
  EXPECT_EQ(both.exit_code, 0);
  EXPECT_EQ(both.output, one.output + "\n" + one.output +
                             "\n2 meshes: 2 usable, 0 not usable as they are, 0 not to be looked "
                             "at\n");
  const Outcome worse = gnbv("lint " + bad + " " + good + " 2>/dev/null");
  EXPECT_EQ(worse.exit_code, 1);
  EXPECT_TRUE(has(worse, "good.obj: usable")) << worse.output;
  EXPECT_TRUE(worse.output.ends_with(
      "\n2 meshes: 1 usable, 1 not usable as it is, 0 not to be looked at\n"))
      << worse.output;
  const Outcome worst = gnbv("lint absent.obj " + bad + " " + good);
  EXPECT_EQ(worst.exit_code, 2);
  EXPECT_TRUE(has(worst, "good.obj: usable")) << worst.output;
  EXPECT_TRUE(has(worst, "1 usable, 1 not usable as it is, 1 not to be looked at")) << worst.output;
  const auto json =
      nlohmann::json::parse(gnbv("lint --json " + bad + " " + good + " 2>/dev/null").output);
  ASSERT_EQ(json.at("meshes").size(), 2U);
  EXPECT_EQ(json.at("meshes").at(0).at("usable"), false);
  EXPECT_EQ(json.at("meshes").at(1).at("usable"), true);
}

TEST(Said, TheCeilingOfARunIsThatOfItsScenario) {
  TempFolder temp;
  setenv("GNBV_CACHE", (temp.path() / "cache").c_str(), 1);
  const std::string run = (temp.path() / "run").string();
  const std::string sets =
      " --set planner.cloud.leaf_m=0.1 --set cameras.0.range_max_m=2.5 --quiet ";
  ASSERT_EQ(
      gnbv("run smoke --set planner.termination.max_iterations=1 --out " + run + sets).exit_code,
      0);
  const auto ceiling = [](const std::string& of) {
    auto json = nlohmann::json::parse(gnbv("ceiling --json --quiet " + of + " 2>/dev/null").output);
    json.erase("wall_s");
    return json;
  };
  EXPECT_EQ(ceiling(run), ceiling("smoke" + sets));
  const Outcome none = gnbv("ceiling " + temp.path().string());
  setenv("GNBV_CACHE", "", 1);
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_TRUE(has(none, "scenario.yaml is missing")) << none.output;
}

TEST(Said, CompareLooksForOneCeilingWhereMethodsShareIt) {
  TempFolder temp;
  setenv("GNBV_CACHE", "", 1);  // nothing is remembered from one search to the next
  const std::string compare =
      "compare smoke --seeds 1 --set planner.termination.max_iterations=1 --set "
      "planner.cloud.leaf_m=0.1 --out " +
      temp.path().string();
  const Outcome shared = gnbv(compare +
                              " --variant planner.agvs.step_m=0.5"
                              " --variant planner.termination.max_distance_m=1"
                              " --variant cameras.0.noise.model=nguyen"
                              " --variant guidance.path_speed_m_s=2");
  EXPECT_EQ(shared.exit_code, 0) << shared.output;
  EXPECT_EQ(count_of(shared.output, "gnbv: ceiling of smoke"), 1U) << shared.output;
  const Outcome none = gnbv(compare + " --variant planner.agvs.step_m=0.5 --no-ceiling");
  EXPECT_EQ(none.exit_code, 0) << none.output;
  EXPECT_FALSE(has(none, "ceiling of smoke") || has(none, "share of ceiling")) << none.output;
  const Outcome other = gnbv(compare + " --variant cameras.0.range_max_m=4");
  EXPECT_EQ(count_of(other.output, "gnbv: ceiling of smoke"), 2U) << other.output;
}

TEST(Said, ANameOfEveryClosedListMayBeASlipOfOne) {
  TempFolder temp;
  const std::string run = (temp.path() / "run").string();
  ASSERT_EQ(
      gnbv("run smoke --quiet --set planner.termination.max_iterations=1 --out " + run).exit_code,
      0);
  for (const auto& [words, meant] : std::vector<std::pair<std::string, std::string>>{
           {"render " + run + " --what covrage", "coverage"},
           {"render " + run + " --camera isoo", "iso"},
           {"plot " + run + " --plots denstiy", "density"},
           {"plot " + run + " --format sgv", "svg"},
           {"export " + run + " --format colmp", "colmap"},
           {"compare smoke --utilities proposd", "proposed"},
           {"compare smoke --format markdwn", "markdown"},
           {"paper -o " + run + " --scenarios lab_modle", "lab_model"},
           {"run smoke --bounds atuo", "auto"}}) {
    const Outcome refused = gnbv(words);
    EXPECT_EQ(refused.exit_code, 2) << words;
    EXPECT_TRUE(refused.output.starts_with("gnbv: --")) << refused.output;
    EXPECT_TRUE(has(refused, "did you mean '" + meant + "'?")) << refused.output;
  }
}

}  // namespace
}  // namespace gnbv
