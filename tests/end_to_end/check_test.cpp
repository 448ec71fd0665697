// Gates of runs, by the program.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "sim/core/file.hpp"
#include "tests/end_to_end/scored_mission.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using test::Score;

/// The gate of this repository's own CI.
TEST_F(Score, SmokeKeepsItsBaseline) {
  const Outcome check =
      gnbv("check " + original().string() + " --against " GNBV_BASELINES "/smoke.json");
  EXPECT_EQ(check.exit_code, 0) << check.output;
}

TEST_F(Score, AWorseMissionFailsTheBaselineByName) {
  const fs::path run = temp_.path() / "worse";
  ASSERT_EQ(
      gnbv("run smoke --quiet --set planner.termination.max_iterations=6 --out " + run.string())
          .exit_code,
      0);
  const Outcome check = gnbv("check " + run.string() + " --against " GNBV_BASELINES "/smoke.json");
  EXPECT_EQ(check.exit_code, 1) << check.output;
  EXPECT_TRUE(has(check, "regressed coverage_0.05")) << check.output;
  EXPECT_TRUE(has(check, "better    flight_time_s")) << check.output;
}

TEST_F(Score, ChecksAgainstABaselineThatItWrote) {
  const std::string baseline = (temp_.path() / "b.json").string();
  const std::string check = "check " + original().string() + " --against " + baseline;
  const Outcome none = gnbv(check);
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_TRUE(has(none, "no such baseline; `gnbv " + check + " --update`")) << none.output;
  ASSERT_EQ(gnbv(check + " --update").exit_code, 0);
  EXPECT_EQ(gnbv(check).exit_code, 0);
  Json changed = Json::parse(read_file(baseline));
  changed["metrics"]["recall"]["value"] = 2.0;
  changed["metrics"]["recall"]["tolerance"] = 0.5;
  changed["result_sha256"] = "other";
  changed["termination"] = "battery";
  write_file_atomically(baseline, changed.dump());
  const Outcome json = gnbv(check + " --json 2>/dev/null");
  EXPECT_EQ(json.exit_code, 1);
  EXPECT_EQ(Json::parse(json.output).at("regressed"), 3);
  EXPECT_TRUE(has(gnbv(check),
                  "termination: " + summary_of(original()).at("termination").get<std::string>() +
                      ", the baseline's is battery"));
  EXPECT_EQ(gnbv(check + " --json --update").exit_code, 2);
  const Outcome worse = gnbv(check + " --update");
  ASSERT_EQ(worse.exit_code, 0);
  EXPECT_TRUE(has(worse, "regressed against " + baseline + ": termination result_sha256 recall"))
      << "taken, but not without a word: " << worse.output;
  const Json updated = Json::parse(read_file(baseline));
  EXPECT_EQ(updated.at("metrics").at("recall").at("tolerance"), 0.5);
  EXPECT_EQ(updated.at("result_sha256"), summary_of(original()).at("result_sha256"));
  changed["of"]["seed"] = 99;
  write_file_atomically(baseline, changed.dump());
  const Outcome other = gnbv(check);
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_TRUE(has(other, "seed 99, the run's is ")) << other.output;
  const Outcome update = gnbv(check + " --update");
  EXPECT_EQ(update.exit_code, 2);
  EXPECT_TRUE(has(update, "seed 99, the run's is ")) << update.output;
}

}  // namespace
}  // namespace gnbv
