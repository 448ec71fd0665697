// What version 0.1 wrote stays readable: fixtures/version_0_1 holds a run of it that was
// interrupted after five of ten views, one that was finished, and scenario files. Nothing in there
// is ever written anew.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "sim/core/file.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temp_folder.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class OldFiles : public testing::Test {
 protected:
  void SetUp() override { fs::copy(GNBV_FIXTURES, folder_, fs::copy_options::recursive); }

  /// The program in the folder of the copies.
  Outcome run(const std::string& arguments) const {
    return gnbv(arguments, "cd " + folder_.string() + " && ");
  }
  json summary_of(const std::string& run) const {
    return json::parse(read_file(folder_ / run / "summary.json"));
  }

  TempFolder temp_;
  const fs::path folder_ = temp_.path() / "old";
};

TEST_F(OldFiles, RunsAreScoredAsTheyScoredThemselves) {
  for (const std::string run_name : {"interrupted", "tour"}) {
    const Outcome scored = run("score --json " + run_name + " 2>/dev/null");
    ASSERT_EQ(scored.exit_code, 0) << scored.output;
    const json now = json::parse(scored.output)["coverage"];
    for (const auto& [of, by_size] : summary_of(run_name)["coverage"].items()) {
      for (const auto& [size, share] : by_size.items()) {
        // rays that graze an edge may differ from machine to machine: one voxel of 300 or so
        EXPECT_NEAR(now[of][size].get<double>(), share.get<double>(), 0.004) << of << size;
      }
    }
  }
}

TEST_F(OldFiles, RunsHaveAReport) {
  const Outcome reported = run("report --quiet interrupted tour -o page.html");
  if (has(reported, "npm")) GTEST_SKIP() << reported.output;
  ASSERT_EQ(reported.exit_code, 0) << reported.output;
  EXPECT_GT(fs::file_size(folder_ / "page.html"), 100000U);
}

TEST_F(OldFiles, AnInterruptedRunGoesOnToItsEnd) {
  ASSERT_EQ(summary_of("interrupted")["iterations"], 5);
  const std::string views = read_file(folder_ / "interrupted/iterations.csv");
  const Outcome resumed =
      run("run interrupted/scenario.yaml --resume --candidates --quiet --out interrupted");
  ASSERT_EQ(resumed.exit_code, 0) << resumed.output;
  const json summary = summary_of("interrupted");
  EXPECT_EQ(summary["termination"], "max_iterations");
  EXPECT_EQ(summary["iterations"], 10);
  // the views that were recorded are still the first
  const std::string all = read_file(folder_ / "interrupted/iterations.csv");
  for (std::size_t at = views.find('\n') + 1; at < views.size(); at = views.find('\n', at) + 1) {
    const std::string row = views.substr(at, views.find(",agvs,", at) - at);
    if (row.starts_with("0,")) continue;
    EXPECT_THAT(all, testing::HasSubstr("\n" + row)) << all;
  }
}

TEST_F(OldFiles, ScenariosMeanWhatTheyMeant) {
  ASSERT_EQ(run("run old_scenario.yaml --quiet --out old").exit_code, 0);
  const Outcome flown = run("run settings.yaml --quiet --out flown");
  ASSERT_EQ(flown.exit_code, 0) << flown.output;
  const std::string resolved = read_file(folder_ / "flown/scenario.yaml");
  for (const char* value : {"5.015625", "31.25", "0.21875", "0.203125", "1.015625", "0.078125",
                            "0.328125", "33", "0.46875", "0.0390625"}) {
    EXPECT_THAT(resolved, testing::HasSubstr(std::string(": ") + value + "\n"));
  }
}

}  // namespace
}  // namespace gnbv
