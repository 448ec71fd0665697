// Tables and comparisons as their users meet them: missions flown, read back and judged.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "sim/core/file.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temp_folder.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const std::string kFewViews = " --set planner.termination.max_iterations=4 ";

/// Rows of a table's JSON where `key` is `value`.
std::vector<Json> rows(const Json& table, const std::string& key, const std::string& value) {
  std::vector<Json> found;
  for (const Json& row : table.at("rows")) {
    if (row.at(key) == value) found.push_back(row);
  }
  return found;
}

TEST(Compare, FliesWhatIsMissingAndJudgesTheRunsThatItsFolderHolds) {
  TempFolder temp;
  const std::string compare = "compare smoke --utilities proposed,bircher --seeds 2 --quiet" +
                              kFewViews + "--out " + temp.path().string() + " --format ";
  const Outcome first = gnbv(compare + "json 2>/dev/null");
  ASSERT_EQ(first.exit_code, 0) << first.output;
  const Json table = Json::parse(first.output);
  const std::vector<Json> coverage = rows(table, "metric", "coverage at 0.05 m (%)");
  ASSERT_EQ(coverage.size(), 2U);
  // the oracle: the summaries of the four runs
  std::map<std::string, std::map<int, double>> covered;
  for (const auto& cell : fs::directory_iterator(temp.path() / "cells")) {
    if (!cell.is_directory()) continue;
    const Json run = Json::parse(read_file(cell.path() / "summary.json"));
    covered[run.at("utility")][run.at("seed")] =
        100.0 * run.at("coverage").at("final").at("0.05").get<double>();
  }
  ASSERT_EQ(covered.size(), 2U);
  const auto& proposed = covered.at("proposed");
  const auto& bircher = covered.at("bircher");
  EXPECT_NEAR(coverage[0].at("mean"), (proposed.at(1) + proposed.at(2)) / 2, 1e-9);
  EXPECT_NEAR(coverage[1].at("difference"),
              (bircher.at(1) - proposed.at(1) + bircher.at(2) - proposed.at(2)) / 2, 1e-9);
  EXPECT_FALSE(rows(table, "metric", "AUC over metres (%)").empty());
  // four views are too few for any share of the ceiling
  EXPECT_TRUE(rows(table, "metric", "metres to 80 % of ceiling").empty());
  EXPECT_NE(table.at("notes").dump().find("smoke: no run got to 80 % of ceiling"),
            std::string::npos);
  EXPECT_FALSE(rows(table, "metric", "share of ceiling at 0.05 m (%)").empty());

  // a run that is there is not flown again: a doctored one is believed
  for (const auto& cell : fs::directory_iterator(temp.path() / "cells")) {
    const fs::path summary = cell.path() / "summary.json";
    if (!fs::exists(summary)) continue;
    Json run = Json::parse(read_file(summary));
    run["distance_m"]["straight"] = 123.0;
    write_file_atomically(summary, run.dump());
  }
  const Outcome second = gnbv(compare + "csv 2>/dev/null");
  ASSERT_EQ(second.exit_code, 0) << second.output;
  EXPECT_TRUE(has(second, "smoke,distance (m),bircher,2,2,123,0,1.5,0,0,1,1,equal"))
      << second.output;
}

TEST(Compare, TakesASweepAndSaysWhatItLacks) {
  TempFolder temp;
  const fs::path file = temp.path() / "grid.yaml";
  std::ofstream(file) << "scenarios: [smoke]\nutilities: [proposed, isler]\nseeds: 2\n"
                         "set: {planner.termination.max_iterations: 2}\n";
  const std::string out = (temp.path() / "sweep").string();
  ASSERT_EQ(gnbv("sweep " + file.string() + " --quiet --index 0 --out " + out).exit_code, 0);
  ASSERT_EQ(gnbv("sweep " + file.string() + " --quiet --index 2 --out " + out).exit_code, 0);
  const Outcome part = gnbv("compare --quiet --from " + out + " --baseline isler");
  EXPECT_EQ(part.exit_code, 1) << part.output;  // two cells of four are missing
  EXPECT_TRUE(has(part, "proposed against isler")) << part.output;
  EXPECT_TRUE(has(part, "one seed: no test")) << part.output;
  EXPECT_TRUE(has(part, "smoke, isler: without a result: not flown (seed 2)")) << part.output;
  ASSERT_EQ(gnbv("sweep " + file.string() + " --quiet --out " + out).exit_code, 0);
  EXPECT_EQ(gnbv("compare --quiet --from " + out).exit_code, 0);
}

TEST(Compare, AFailureOfAnEarlierCallIsFlownAgain) {
  TempFolder temp;
  const std::string compare = "compare smoke --utilities proposed,isler --seeds 1 --quiet" +
                              kFewViews + "--out " + temp.path().string();
  ASSERT_EQ(gnbv(compare).exit_code, 0);
  std::vector<fs::path> runs;
  for (const auto& cell : fs::directory_iterator(temp.path() / "cells")) {
    if (cell.is_directory()) runs.push_back(cell.path());
  }
  ASSERT_EQ(runs.size(), 2U);
  fs::remove_all(runs[0]);  // as a mission leaves it that was killed, say, for its memory
  std::ofstream(runs[0].string() + ".failed.json") << R"({"failure": "killed by signal 9"})";
  const Outcome again = gnbv(compare);
  EXPECT_EQ(again.exit_code, 0) << again.output;
  EXPECT_TRUE(fs::exists(runs[0] / "summary.json"));
}

TEST(Compare, FromASweepTakesNothingThatWouldFlyOtherMissions) {
  for (const std::string option : {"--mesh m.obj", "--seed 2", "--set planner.cloud.leaf_m=0.1",
                                   "--bounds auto", "--seeds 3", "--jobs 2", "--out o"}) {
    const Outcome refused = gnbv("compare --from sweep " + option);
    EXPECT_EQ(refused.exit_code, 2) << option;
    EXPECT_TRUE(has(refused, "excludes")) << refused.output;
    EXPECT_TRUE(has(refused, option.substr(0, option.find(' ')))) << refused.output;
  }
}

TEST(Compare, AMethodThatChangesTheLeafHasItsOwnCeiling) {
  TempFolder temp;
  const std::string out = " --out " + temp.path().string();
  const Outcome both =
      gnbv("compare smoke --vary planner.cloud.leaf_m=0.05,0.2 --seeds 1 --quiet --format json" +
           kFewViews + out + " 2>/dev/null");
  ASSERT_EQ(both.exit_code, 0) << both.output;
  const Json table = Json::parse(both.output);
  const std::vector<Json> covered = rows(table, "metric", "coverage at 0.05 m (%)");
  const std::vector<Json> shares = rows(table, "metric", "share of ceiling at 0.05 m (%)");
  ASSERT_EQ(shares.size(), 2U);
  for (const std::size_t i : {0, 1}) {
    const std::string leaf = i == 0 ? "0.05" : "0.2";
    const Outcome one =
        gnbv("ceiling smoke --quiet --json --set planner.cloud.leaf_m=" + leaf + " 2>/dev/null");
    const double ceiling = Json::parse(one.output).at("leaf_outside").at("0.05");
    EXPECT_NEAR(shares[i].at("mean"), covered[i].at("mean").get<double>() / ceiling, 1e-9) << leaf;
  }
}

TEST(Compare, AMeshThatIsGoneCostsItsCeilingOnly) {
  TempFolder temp;
  const fs::path mesh = temp.path() / "box.obj";
  std::ofstream(mesh) << "v 0 0 1\nv 1 0 1\nv 0 1 1\nv 0 0 2\n"
                         "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  std::ofstream(temp.path() / "grid.yaml")
      << "scenarios: {name: box, scenario: smoke, mesh: box.obj}\nutilities: [proposed, isler]\n"
         "set: {planner.termination.max_iterations: 1}\n";
  const std::string out = (temp.path() / "sweep").string();
  ASSERT_EQ(
      gnbv("sweep " + (temp.path() / "grid.yaml").string() + " --quiet --out " + out).exit_code, 0);
  fs::remove(mesh);
  const Outcome gone = gnbv("compare --quiet --from " + out);
  EXPECT_EQ(gone.exit_code, 0) << gone.output;
  EXPECT_TRUE(has(gone, "box, isler: no share of ceiling: ")) << gone.output;
  EXPECT_TRUE(has(gone, mesh.string())) << gone.output;
}

TEST(Compare, NamesAllFaultsBeforeItFlies) {
  TempFolder temp;
  const std::string out = (temp.path() / "out").string();
  const Outcome faults = gnbv(
      "compare smoke --utilities proposed,best --presets relased --variant "
      "planner.utilty.name=isler --out " +
      out);
  EXPECT_EQ(faults.exit_code, 2);
  for (const std::string word : {"'best'", "'relased'", "planner.utilty"}) {
    EXPECT_TRUE(has(faults, word)) << word << " in " << faults.output;
  }
  const Outcome baseline = gnbv("compare smoke --utilities a,b --baseline c --out " + out);
  EXPECT_EQ(baseline.exit_code, 2);
  EXPECT_TRUE(has(baseline, "'c': no method of this comparison; it has: a, b")) << baseline.output;
  EXPECT_EQ(gnbv("compare smoke --utilities proposed --out " + out).exit_code, 2);
  EXPECT_EQ(gnbv("compare smoke --utilities proposed,isler --seeds 0 --out " + out).exit_code, 2);
  EXPECT_EQ(gnbv("compare --utilities proposed,isler --out " + out).exit_code, 2);
  EXPECT_EQ(gnbv("compare smoke smoke --utilities proposed,isler --out " + out).exit_code, 2);
  EXPECT_EQ(gnbv("compare --from " + out).exit_code, 2);
  EXPECT_FALSE(fs::exists(out));
}

TEST(Table, HasThePapersRowOursTheOraclesAndTheCeiling) {
  TempFolder temp;
  // the smallest scenario, under the name of one that the paper has figures of
  const std::string table = "table smoke --set name=lab_model --seeds 2 --quiet" + kFewViews +
                            "--out " + temp.path().string() + " 2>/dev/null --format ";
  const Outcome json = gnbv(table + "json");
  ASSERT_EQ(json.exit_code, 0) << json.output;
  const Json parsed = Json::parse(json.output);
  std::vector<std::string> order;
  for (const Json& row : parsed.at("rows")) {
    order.push_back(row.at("utility").get<std::string>() + ": " + row.at("row").get<std::string>());
  }
  EXPECT_EQ(order, (std::vector<std::string>{"Proposed: ours", "Proposed: paper", "Tour: ours",
                                             "Oracle, few views: ours", "Oracle, few metres: ours",
                                             "Profile: ours", "Ceiling: physical",
                                             "Ceiling: leaf filter"}));
  EXPECT_EQ(parsed.at("rows").at(0).at("runs"), 2);
  EXPECT_EQ(parsed.at("rows").at(0).at("iterations"), 4);
  EXPECT_EQ(parsed.at("rows").at(1).at("entropy_reduction"), 30140);
  EXPECT_TRUE(parsed.at("rows").at(0).at("time_min").is_number());
  EXPECT_TRUE(parsed.at("rows").at(0).at("share_of_ceiling").is_number());
  for (const int ours : {0, 2, 3, 4}) {  // and how many of the two runs got there
    EXPECT_TRUE(parsed.at("rows").at(ours).at("metres_to_90_runs").is_number()) << ours;
  }
  EXPECT_TRUE(parsed.at("rows").at(1).at("metres_to_90_runs").is_null());  // the paper's
  // every other form has the same rows and the command that repeats it
  for (const std::string format : {"terminal", "markdown", "csv", "latex"}) {
    const Outcome other = gnbv(table + format);
    EXPECT_EQ(other.exit_code, 0) << format;
    EXPECT_TRUE(has(other, "gnbv table smoke") && has(other, "seeds 2")) << other.output;
    EXPECT_TRUE(has(other, "Oracle, few metres")) << format;
    EXPECT_TRUE(has(other, "how many runs got there")) << format;
    EXPECT_TRUE(has(other, "ours is of smoke, which is not known to be")) << format;
  }
}

TEST(Table, FliesAgainWithoutNoiseWhatLiesAboveTheCeiling) {
  TempFolder temp;
  // noise of some decimetres fills voxels that a point a leaf of 0.04 m cannot
  const Outcome json = gnbv(
      "table smoke --set name=lab_model --no-oracle --quiet"
      " --set cameras.0.noise.model=stereo --set cameras.0.noise.disparity_noise_px=2"
      " --set cameras.0.width_px=640 --set cameras.0.height_px=480"
      " --set planner.cloud.leaf_m=0.04 --set planner.validity.collision_radius_m=1.3"
      " --set planner.termination.max_iterations=30 --format json --out " +
      temp.path().string() + " 2>/dev/null");
  ASSERT_EQ(json.exit_code, 0) << json.output;
  const Json parsed = Json::parse(json.output);
  const Json& noisy = parsed.at("rows").at(0);
  const Json& exact = parsed.at("rows").at(1);
  EXPECT_EQ(noisy.at("utility"), "Proposed");
  EXPECT_EQ(exact.at("utility"), "Proposed, exact sensors");
  EXPECT_GT(noisy.at("share_of_ceiling").get<double>(), 1.0);
  EXPECT_LT(exact.at("share_of_ceiling").get<double>(), 1.0);
  EXPECT_TRUE(exact.at("metres_to_90_runs").is_number());
}

}  // namespace
}  // namespace gnbv
