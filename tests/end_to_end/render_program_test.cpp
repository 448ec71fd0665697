// `gnbv render` as its users run it: what is drawn, what is refused, what is said.
#include <gtest/gtest.h>

#include "tests/support/made_run.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temp_folder.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

class RenderProgram : public ::testing::Test {
 protected:
  fs::path made_run(const std::string& name) const {
    fs::create_directories(temp_.path() / name);
    write_made_run(temp_.path() / name);
    return temp_.path() / name;
  }
  Outcome render(const std::string& arguments) const {
    return gnbv("render " + arguments + " --width 320 --height 240",
                "cd " + temp_.path().string() + " && ");
  }
  bool exists(const std::string& name) const { return fs::exists(temp_.path() / name); }

  TempFolder temp_;
};

TEST_F(RenderProgram, RunsOfOneNameGetAPictureEach) {
  made_run("x/run");
  made_run("y/run");
  const Outcome outcome = render("x/run y/run/ --what path -o pics --sheet sheet.png");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  for (const char* const name : {"pics/run-path.png", "pics/run-2-path.png", "sheet.png"}) {
    EXPECT_TRUE(exists(name)) << name;
  }
}

TEST_F(RenderProgram, DrawsTheRunsThatCanBeDrawnAndNamesTheOthers) {
  made_run("whole");
  fs::remove(made_run("less") / "cloud.ply");
  const Outcome outcome = render("whole less --what cloud -o pics --sheet sheet.png");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_TRUE(exists("pics/whole-cloud.png"));
  EXPECT_FALSE(exists("pics/less-cloud.png"));
  EXPECT_TRUE(exists("sheet.png"));
  EXPECT_TRUE(has(outcome, "gnbv: cloud of less: "));
  EXPECT_EQ(render("whole less --what cloud -o pics --quiet").output, "pics/whole-cloud.png\n");
  EXPECT_EQ(render("less --what cloud").exit_code, 2);
}

TEST_F(RenderProgram, NumbersAndNamesThatMakeNoPictureAreRefused) {
  made_run("run");
  write_file_atomically(temp_.path() / "camera.json",
                        R"({"position_m": [0, 1], "target_m": [0, 0, 1]})");
  write_file_atomically(temp_.path() / "typo.json", R"({"position": [0, 1, 2]})");
  for (const auto& [options, words] : std::vector<std::pair<std::string, std::string>>{
           {"run --azimuth-deg nan", "'nan' must be a finite number"},
           {"run --elevation-deg nan", "'nan' must be from -89 to 90"},
           {"run --iteration -1", "--iteration: Value -1 not in range"},
           {"run --camera camera.json", "camera.json: position_m: [0,1] is not three numbers"},
           {"run --camera typo.json", "typo.json: position: no such key"},
           {"run -o picture.jpg", "--out picture.jpg: pictures are .png"},
           {"run -o film.mp4", "--out film.mp4: the name of a path ends in .png"},
           {"run -o run/cloud.ply/deeper", "run/cloud.ply"},
           {"run --over-surface",
            "path of run: no run/surface/surface.obj: `gnbv surface run` makes"},
           {"run --sheet sheet.jpg", "--sheet sheet.jpg: a sheet is a .png"},
           {"''", "RUN: is empty"}}) {
    const Outcome refused = render(options);
    EXPECT_EQ(refused.exit_code, 2) << options;
    EXPECT_TRUE(has(refused, words)) << refused.output;
    EXPECT_EQ(refused.output.find("internal error"), std::string::npos) << refused.output;
    EXPECT_LT(refused.output.size(), 300U) << refused.output;
  }
}

TEST_F(RenderProgram, DrawsWhatAnIncompleteRunHas) {
  for (const bool has_views : {false, true}) {
    const fs::path run = made_run(has_views ? "some" : "none");
    for (const char* const name : {"trajectory.tum", "cloud.ply", "profile.ply"}) {
      fs::remove(run / name);
    }
    if (!has_views) fs::remove(run / "iterations.csv");
    const Outcome outcome = render(run.string() + " --what all");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    EXPECT_TRUE(fs::exists(run / "path.png"));
    EXPECT_TRUE(fs::exists(run / "profile.png"));  // flown again: it needs the scenario only
    EXPECT_FALSE(fs::exists(run / "cloud.png"));
    EXPECT_TRUE(has(outcome, "gnbv: cloud of "));
  }
}

TEST_F(RenderProgram, RefusesOptionsThatItWouldIgnore) {
  made_run("run");
  write_file_atomically(temp_.path() / "camera.json",
                        R"({"position_m": [0, -9, 3], "target_m": [0, 0, 3]})");
  for (const char* const option :
       {"--camera camera.json --azimuth-deg 10", "--camera camera.json --elevation-deg 10",
        "--what snapshots,movie --sheet sheet.png", "--what cloud --over-surface"}) {
    const Outcome outcome = render(std::string("run ") + option);
    EXPECT_EQ(outcome.exit_code, 2) << option << outcome.output;
  }
  EXPECT_FALSE(exists("run/path.png"));
  const Outcome huge =
      gnbv("render " + (temp_.path() / "run").string() + " --width 8192 --height 8192");
  EXPECT_EQ(huge.exit_code, 2);
  EXPECT_TRUE(has(huge, "--width and --height"));
}

}  // namespace
}  // namespace gnbv
