// `--views`: a user's views in a file, and another planner at the other end of a pipe.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "sim/core/file.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temp_folder.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char* kViews =
    "x,y,z,yaw_deg\n3.2,0,2,180\n0,9,2,0\n\n# a remark\n0,3.2,2.5,-90\n-3.2,0,2,0\n";
constexpr const char* kRun = "run smoke --seed 2 --utility route --quiet --views ";

std::vector<Json> lines_of(const std::string& output) {
  std::vector<Json> lines;
  std::istringstream in(output);
  for (std::string line; std::getline(in, line);) lines.push_back(Json::parse(line));
  return lines;
}

std::string sha_of(const fs::path& run) {
  return Json::parse(read_file(run / "summary.json")).at("result_sha256");
}

class ViewPipe : public testing::Test {
 protected:
  void SetUp() override { write_file_atomically(file("views.csv"), kViews); }
  fs::path file(const std::string& name) const { return temp_.path() / name; }

  /// Answers to the text on stdin.
  std::vector<Json> pipe(const std::string& text, const std::string& arguments) const {
    write_file_atomically(file("stdin"), text);
    const Outcome outcome = gnbv(arguments + " 2>/dev/null <" + file("stdin").string());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    return lines_of(outcome.output);
  }

  TempFolder temp_;
};

TEST_F(ViewPipe, AFileAndAPipeAndTheRunsOwnScenarioFlyTheSame) {
  const Outcome flown = gnbv(kRun + file("views.csv").string() + " --out " + file("file").string());
  ASSERT_EQ(flown.exit_code, 0) << flown.output;
  EXPECT_TRUE(has(flown, "1 of 4 given views refused")) << flown.output;
  EXPECT_EQ(Json::parse(read_file(file("file/summary.json"))).at("termination"), "route_flown");
  pipe(kViews, kRun + std::string("- --out ") + file("pipe").string());
  EXPECT_EQ(sha_of(file("pipe")), sha_of(file("file")));
  EXPECT_EQ(read_file(file("pipe/scenario.yaml")), read_file(file("file/scenario.yaml")));
  EXPECT_EQ(read_file(file("pipe/views.csv")), read_file(file("file/views.csv")));
  const Outcome again = gnbv("run " + file("pipe/scenario.yaml").string() + " --quiet --out " +
                             file("again").string());
  ASSERT_EQ(again.exit_code, 0) << again.output;
  EXPECT_EQ(sha_of(file("again")), sha_of(file("file")));
  // and the record of what became of the views is a list of views itself
  const Outcome from_record =
      gnbv(kRun + file("pipe/views.csv").string() + " --out " + file("rec").string());
  ASSERT_EQ(from_record.exit_code, 0) << from_record.output;
  EXPECT_EQ(sha_of(file("rec")), sha_of(file("file")));
}

TEST_F(ViewPipe, AnswersEveryViewWithOneLine) {
  const auto answers =
      pipe(std::string(kViews) + "1,2,three,4\n",
           kRun + std::string("- --frames --coverage --out ") + file("run").string());
  ASSERT_EQ(answers.size(), 7U);  // start, four views, one that is none, end
  const std::vector<std::string> events = {"start", "flown",     "refused", "flown",
                                           "flown", "malformed", "end"};
  for (std::size_t i = 0; i < events.size(); ++i) EXPECT_EQ(answers[i].at("event"), events[i]) << i;
  EXPECT_EQ(answers[2], Json::parse(R"({"event":"refused","view":1,"reason":"out_of_bounds"})"));
  EXPECT_EQ(answers[5].at("what"), "stdin:8: z `three` is not a number");
  std::size_t points = answers[0].at("points").get<std::size_t>();
  double flown_m = 0.0;
  for (const std::size_t i : {1U, 3U, 4U}) {
    const Json& a = answers[i];
    EXPECT_EQ(a.at("view"), i - 1);
    points += a.at("new_points").get<std::size_t>();
    EXPECT_EQ(a.at("points"), points);
    EXPECT_GT(a.at("flown_m").get<double>(), flown_m);
    flown_m = a.at("flown_m");
    const Json& camera = a.at("cameras").at(0);
    EXPECT_EQ(camera.at("name"), "rgbd");
    EXPECT_TRUE(fs::exists(camera.at("rgb").get<std::string>()));
    EXPECT_TRUE(fs::exists(camera.at("depth").get<std::string>()));
  }
  // where it was asked to be, as far as it flies
  EXPECT_NEAR(answers[1].at("position_m").at(0).get<double>(), 3.2, 0.15);
  EXPECT_NEAR(std::abs(answers[1].at("yaw_deg").get<double>()), 180.0, 4.0);
  EXPECT_GT(answers[4].at("coverage").at("0.05"), answers[0].at("coverage").at("0.05"));
  const Json summary = Json::parse(read_file(file("run/summary.json")));
  EXPECT_NEAR(answers[4].at("coverage").at("0.05").get<double>(),
              summary.at("coverage").at("final").at("0.05").get<double>(), 1e-9);
  EXPECT_EQ(answers[6].at("result_sha256"), summary.at("result_sha256"));
  EXPECT_EQ(answers[6].at("run"), file("run").string());
}

/// Stopped while it waits for a view; the rest comes in a second call.
TEST_F(ViewPipe, GoesOnWhereItWasInterrupted) {
  pipe(kViews, kRun + std::string("- --out ") + file("whole").string());
  write_file_atomically(file("first"), "x,y,z,yaw_deg\n3.2,0,2,180\n0,9,2,0\n");
  const std::string rest = "x,y,z,yaw_deg\n0,3.2,2.5,-90\n-3.2,0,2,0\n";
  // stdin stays open: after the start and two answers only the signal ends the wait
  write_file_atomically(file("cut.sh"), std::string("mkfifo in out\n") + GNBV_PROGRAM + " " + kRun +
                                            "- --out cut <in >out 2>said &\n"
                                            "exec 3>in\n"
                                            "cat first >&3\n"
                                            "{ read a; read b; read c; kill -TERM $!; cat; } <out\n"
                                            "wait $!; echo exit $?; cat said\n");
  const Outcome cut = shell("cd " + temp_.path().string() + " && timeout 300 sh cut.sh");
  EXPECT_TRUE(has(cut, "exit 1")) << cut.output;
  EXPECT_TRUE(has(cut, "interrupted after 2 views")) << cut.output;
  EXPECT_TRUE(has(cut, "gnbv run cut/scenario.yaml --views - --resume --out cut")) << cut.output;
  const auto answers = pipe(rest, "run " + file("cut/scenario.yaml").string() +
                                      " --quiet --views - --resume --out " + file("cut").string());
  ASSERT_EQ(answers.size(), 6U);  // those of before come again
  EXPECT_EQ(answers[2].at("event"), "refused");
  EXPECT_EQ(answers.back().at("termination"), "route_flown");
  EXPECT_EQ(sha_of(file("cut")), sha_of(file("whole")));
}

TEST_F(ViewPipe, FliesToTheEndWhoeverListens) {
  std::string views = "x,y,z,yaw_deg\n";  // whose answers are more than a buffer holds
  for (int i = 0; i < 30; ++i) views += fmt::format("3.2,0,2,{}\n", 170 + i % 2 * 20);
  write_file_atomically(file("many"), views);
  const Outcome first =
      shell(std::string(GNBV_PROGRAM) + " " + kRun +
            "- --set planner.termination.max_iterations=40 --out " + file("deaf").string() +
            " 2>/dev/null <" + file("many").string() + " | head -n 1");
  EXPECT_TRUE(has(first, "\"event\":\"start\"")) << first.output;
  EXPECT_EQ(Json::parse(read_file(file("deaf/summary.json"))).at("termination"), "route_flown");
}

TEST_F(ViewPipe, NamesNoCameraWhoseFrameWasLost) {
  const auto answers =
      pipe(kViews, kRun + std::string("- --frames --set cameras.0.drop_probability=1 --out ") +
                       file("blind").string());
  ASSERT_EQ(answers.size(), 6U);
  for (const Json& answer : answers) {
    if (answer.at("event") != "start" && answer.at("event") != "flown") continue;
    EXPECT_TRUE(answer.at("cameras").empty()) << answer;
    EXPECT_EQ(answer.at("new_points"), 0) << answer;
    EXPECT_EQ(answer.at("position_m").size(), 3U);
  }
}

TEST_F(ViewPipe, RefusesWhatDoesNotGoTogether) {
  const auto refused = [&](const std::string& arguments, const std::string& words) {
    const Outcome outcome = gnbv(arguments + " --out " + file("none").string() + " </dev/null");
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    EXPECT_TRUE(has(outcome, words)) << outcome.output;
    EXPECT_FALSE(fs::exists(file("none"))) << arguments;
  };
  write_file_atomically(file("bad"), "x,y,z,yaw_deg\n1,2,3,up\n");
  refused(kRun + file("bad").string(), "bad:2: yaw_deg `up` is not a number");
  refused(kRun + file("gone").string(), "gone");
  refused("run smoke --utility route", "planner.routes.views: holds no view");
  refused("run smoke --views -", "--views -: goes with --utility route, not proposed");
  refused("run smoke --views " + file("views.csv").string(), "goes with --utility route");
  refused("run smoke --coverage", "--coverage");
  refused("compare smoke --utilities bircher,isler --views " + file("views.csv").string(),
          "goes with route among --utilities");
}

TEST_F(ViewPipe, IsComparedWithOthers) {
  const Outcome outcome = gnbv(
      "compare smoke --utilities route,nearest_frontier --seeds 2 --quiet --set "
      "planner.termination.max_iterations=4 --views " +
      file("views.csv").string() + " --out " + file("bench").string() + " --format csv");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_TRUE(has(outcome, "route")) << outcome.output;
}

}  // namespace
}  // namespace gnbv
