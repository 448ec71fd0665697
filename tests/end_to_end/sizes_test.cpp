// Voxel sizes of the user's own, and the score of a part, by the program.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "sim/mesh/mesh_file.hpp"
#include "tests/bench/shapes.hpp"
#include "tests/end_to_end/scored_mission.hpp"
#include "tools/run/cloud_file.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

class Sizes : public test::Score {
 protected:
  /// The mission that Score flew, scored at a size more.
  fs::path finer() const {
    const fs::path run = copy();
    const Outcome scored = gnbv("score " + run.string() + " --resolution 0.05,0.2 --update");
    EXPECT_EQ(scored.exit_code, 0) << scored.output;
    EXPECT_TRUE(has(scored, "Coverage, voxels of           0.05 m    0.20 m\n")) << scored.output;
    return run;
  }
  static Json json_of(const std::string& arguments) {
    Json json = Json::parse(gnbv(arguments + " --json 2>/dev/null").output);
    json.erase("wall_s");
    return json;
  }
};

TEST_F(Sizes, OfTheScenarioAreThoseOfTheScoreAndChangeNoMission) {
  const fs::path flown = temp_.path() / "flown";
  const Outcome run =
      gnbv("run smoke --quiet --set score.sizes_m=[0.05,0.2] --out " + flown.string());
  ASSERT_EQ(run.exit_code, 0) << run.output;
  EXPECT_TRUE(has(run, "0.50 m  0.20 m")) << run.output;
  const fs::path scored = finer();
  EXPECT_EQ(read_file(flown / "coverage.csv"), read_file(scored / "coverage.csv"));
  EXPECT_TRUE(
      read_file(flown / "coverage.csv")
          .starts_with(
              "view,metres,seconds,coverage_0.05,coverage_0.10,coverage_0.50,coverage_0.20\n"));
  const Json summary = summary_of(flown);
  EXPECT_EQ(summary.at("coverage"), summary_of(scored).at("coverage"));
  EXPECT_EQ(summary.at("result_sha256"), summary_of(original()).at("result_sha256"));
  EXPECT_EQ(summary.at("coverage").at("final").at("0.05"),
            summary_of(original()).at("coverage").at("final").at("0.05"));
  // between its neighbours, and that of the cloud alone
  const Json at = summary.at("coverage").at("final");
  EXPECT_GT(at.at("0.20"), at.at("0.05"));
  const Json cloud =
      json_of("score " + (flown / "cloud.ply").string() + " --scenario smoke --resolution 0.2");
  EXPECT_EQ(cloud.at("coverage").at("final"), at);
}

TEST_F(Sizes, AreGatedComparedAndDrawn) {
  const std::string run = finer().string();
  const std::string gate = (temp_.path() / "gate.json").string();
  ASSERT_EQ(gnbv("check " + run + " --against " + gate + " --update").exit_code, 0);
  Json baseline = Json::parse(read_file(gate));
  EXPECT_EQ(baseline.at("metrics").at("coverage_0.20").at("value"),
            summary_of(run).at("coverage").at("final").at("0.20"));
  EXPECT_EQ(gnbv("check " + run + " --against " + gate).exit_code, 0);
  baseline["metrics"]["coverage_0.20"]["value"] = 1.5;
  write_file_atomically(gate, baseline.dump());
  const Outcome worse = gnbv("check " + run + " --against " + gate);
  EXPECT_EQ(worse.exit_code, 1);
  EXPECT_TRUE(has(worse, "coverage_0.20")) << worse.output;
  for (const char* const update : {"", " --update"}) {
    const Outcome without = gnbv("check " + original().string() + " --against " + gate + update);
    EXPECT_EQ(without.exit_code, 2) << update;
    EXPECT_TRUE(has(without, "metrics.coverage_0.20: the run was not scored at that size"))
        << without.output;
  }

  const std::string plots = (temp_.path() / "plots").string();
  const Outcome drawn =
      gnbv("plot " + run + " --plots coverage --voxel 0.2 --format json -o " + plots);
  ASSERT_EQ(drawn.exit_code, 0) << drawn.output;
  EXPECT_NE(read_file(fs::path(plots) / "coverage-views.csv").find("0.20 m"), std::string::npos);
  const Outcome none = gnbv("plot " + original().string() +
                            " --plots coverage --voxel 0.2 --format json -o " + plots + "2");
  EXPECT_TRUE(has(none, "not scored at 0.20 m: left out")) << none.output;
}

TEST_F(Sizes, HaveTheirRowsInAComparison) {
  const Outcome compared = gnbv(
      "compare smoke --utilities proposed,isler --seeds 1 --quiet --no-ceiling --format json --set "
      "score.sizes_m=[0.2] --set planner.termination.max_iterations=2 --out " +
      (temp_.path() / "bench").string() + " 2>/dev/null");
  ASSERT_EQ(compared.exit_code, 0) << compared.output;
  int rows = 0;
  const Json table = Json::parse(compared.output);
  for (const Json& row : table.at("rows")) {
    rows += row.at("metric") == "coverage at 0.20 m (%)" ? 1 : 0;
  }
  EXPECT_EQ(rows, 2);  // of each method
}

TEST_F(Sizes, ThatAreNoneAreRefused) {
  for (const auto& [option, words] : std::vector<std::pair<std::string, std::string>>{
           {"--resolution 0", "--resolution 0"},
           {"--resolution 0.05,0.05", "is there twice"},
           {"--box 0,0,0,1,1", "x0,y0,z0,x1,y1,z1"},
           {"--box 0,0,0,1,1,0", "x0,y0,z0,x1,y1,z1"},
           {"--box 9,9,9,10,10,10", "nothing to measure"},
           {"--box 0,0,0,1,1,1 --update", "--box"}}) {
    const Outcome refused = gnbv("score " + original().string() + " " + option);
    EXPECT_EQ(refused.exit_code, 2) << option;
    EXPECT_TRUE(has(refused, words)) << refused.output;
  }
  for (const auto& [sizes, words] : std::vector<std::pair<std::string, std::string>>{
           {"[]", "1 to 16 numbers"},
           {"0.05", "1 to 16 numbers"},
           {"[0.05,0.05]", "score.sizes_m.1: value '0.05': is there twice"},
           {"[0.001]", "out of range"}}) {
    const Outcome refused =
        gnbv("run smoke --out " + (temp_.path() / "no").string() + " --set score.sizes_m=" + sizes);
    EXPECT_EQ(refused.exit_code, 2) << sizes;
    EXPECT_TRUE(has(refused, words)) << refused.output;
  }
}

TEST_F(Sizes, ThatNoMemoryHoldsAreRefusedBeforeAFileIsWritten) {
  TriangleMesh field;  // 2,600 m2
  test::add_sheet(field, Vec3(-25, -26, 1), Vec3(50, 0, 0), Vec3(0, 52, 0));
  const std::string mesh = (temp_.path() / "field.ply").string();
  write_mesh(field, mesh);
  const fs::path out = temp_.path() / "none";
  const Outcome run = gnbv("run smoke --bounds auto --mesh " + mesh + " --out " + out.string() +
                           " --set planner.map.resolution_m=0.5 --set score.sizes_m=[0.01]");
  const Outcome score = gnbv("score " + (original() / "cloud.ply").string() + " --mesh " + mesh +
                             " --resolution 0.01");
  for (const Outcome& refused : {run, score}) {
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_TRUE(has(refused, "0.011 m fits")) << refused.output;
  }
  EXPECT_FALSE(fs::exists(out));
}

TEST_F(Sizes, TheScoreOfABoxIsOfWhatLiesInIt) {
  const std::string cloud = (original() / "cloud.ply").string();
  const std::string score = "score --scenario smoke --resolution 0.05,0.2 ";
  EXPECT_EQ(json_of(score + cloud + " --box=-9,-9,-9,9,9,9"), json_of(score + cloud));
  // what is far from the box does not matter
  const Vec3 lo(-9, -9, -9), hi(0.0, 9, 9);
  std::vector<Vec3f> near_it;
  for (const Vec3f& p_m : read_cloud(original() / "cloud.ply")) {
    if (p_m.x() < 0.3F) near_it.push_back(p_m);
  }
  const fs::path xyz = temp_.path() / "near.xyz";
  std::ofstream file(xyz);
  file.precision(9);
  for (const Vec3f& p_m : near_it) file << p_m.x() << ' ' << p_m.y() << ' ' << p_m.z() << '\n';
  file.close();
  const std::string box = " --box=-9,-9,-9,0,9,9";
  Json all = json_of(score + cloud + box);
  Json part = json_of(score + xyz.string() + box);
  EXPECT_LT(part.at("points"), all.at("points"));
  for (Json* json : {&all, &part}) {
    for (const char* key : {"points", "completeness_m", "chamfer_m", "points_below_floor"}) {
      json->erase(key);
    }
  }
  EXPECT_EQ(all, part);
  EXPECT_NE(all.at("coverage"), json_of(score + cloud).at("coverage"));
}

}  // namespace
}  // namespace gnbv
