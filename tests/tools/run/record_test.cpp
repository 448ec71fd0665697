// Laws of reading a run back: what was written is what is read, what is missing is named with the
// command that makes it, what is damaged is named with its line.
#include <gtest/gtest.h>

#include <limits>

#include "sim/core/text.hpp"
#include "tests/support/fault.hpp"
#include "tests/support/made_frames.hpp"
#include "tests/support/made_run.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/run/frames_folder.hpp"
#include "tools/run/run_directory.hpp"
#include "tools/run/run_record.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using test::fault_of;
using test::says;

class Record : public ::testing::Test {
 protected:
  Record() { write_made_run(temp_.path()); }

  void write(const std::string& name, const std::string& content) const {
    write_file_atomically(temp_.path() / name, content);
  }
  void remove(const std::string& name) const { fs::remove_all(temp_.path() / name); }
  testing::AssertionResult refused(const std::string& words) const {
    return says(fault_of([&] { read_run(temp_.path()); }), {words});
  }
  testing::AssertionResult refuses_cloud(const std::string& words) const {
    return says(fault_of([&] { read_run_cloud(read_run(temp_.path())); }), {words});
  }
  testing::AssertionResult refuses_frames(const std::string& words) const {
    return says(fault_of([&] { read_frames(temp_.path()); }), {words});
  }
  std::vector<int> views_of_points() const {
    const RunCloud cloud = read_run_cloud(read_run(temp_.path()));
    std::vector<int> views;
    for (std::size_t i = 0; i < cloud.points_world_m.size(); ++i) views.push_back(cloud.view_of(i));
    return views;
  }

  TempFolder temp_;
};

TEST_F(Record, EveryPointBelongsToTheViewThatBroughtItAndThoseAfterTheLastToNone) {
  EXPECT_EQ(views_of_points(), (std::vector<int>{-1, -1, 0, 1, 1, 2}));
  const std::string views = read_file(temp_.path() / "iterations.csv");
  write("iterations.csv", views.substr(0, views.rfind('\n', views.size() - 2) + 1));
  EXPECT_EQ(views_of_points(), (std::vector<int>{-1, -1, 0, 1, 1, 2}));
  write("iterations.csv", views.substr(0, views.find('\n') + 1));
  EXPECT_EQ(views_of_points(), (std::vector<int>{-1, -1, 0, 0, 0, 0}));
}

TEST_F(Record, CommandsAreWordsForAShell) {
  const fs::path folder = temp_.path() / "my run";
  fs::create_directories(folder);
  write_made_run(folder);
  fs::remove(folder / "iterations.csv");
  const RunRecord record = read_run(folder);
  ASSERT_EQ(record.missing.size(), 2U);
  for (const std::string& missing : record.missing) {
    EXPECT_TRUE(says(missing, {"run/scenario.yaml' --resume --out '"}));
  }
  EXPECT_TRUE(says(command_to_fly_again(folder, "--frames"), {"my run/scenario.yaml' --frames"}));
}

TEST(Words, NamesOfOursAreReadAsWordsAndThoseOfUsersStay) {
  EXPECT_EQ(human_name("power_plant"), "Power plant");
  EXPECT_EQ(human_name("aep"), "AEP");
  EXPECT_EQ(human_name("mine.py:gain"), "mine.py:gain");
  EXPECT_EQ(human_name("MyPlant"), "MyPlant");
  EXPECT_EQ(human_name(""), "");
}

/// Beside every value, of the amounts 1, 2 and 5 times a power of ten, the next ones.
TEST(Words, AmountsAreRoundedToTheNextOneTwoOrFive) {
  const std::vector<double> amounts = {0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100};
  for (std::size_t i = 1; i < amounts.size(); ++i) {
    for (const double share : {0.01, 0.5, 0.99}) {
      const double between = amounts[i - 1] + share * (amounts[i] - amounts[i - 1]);
      EXPECT_DOUBLE_EQ(rounded_up_125(between), amounts[i]) << between;
      EXPECT_DOUBLE_EQ(rounded_down_125(between), amounts[i - 1]) << between;
    }
    EXPECT_DOUBLE_EQ(rounded_up_125(amounts[i]), amounts[i]);
    EXPECT_DOUBLE_EQ(rounded_down_125(amounts[i]), amounts[i]);
  }
}

TEST(Words, ThousandsAreApart) {
  EXPECT_EQ(counted(1, "view"), "1 view");
  EXPECT_EQ(counted(1200, "view"), "1,200 views");
}

TEST_F(Record, TheTitleNamesAnUnusualReadingOfThePaper) {
  RunRecord record = made_record();
  EXPECT_EQ(run_title(record), "Smoke, Proposed");
  EXPECT_EQ(run_detail(record), "3 views, 0.0 m flown");
  record.scenario.planner.preset = "released";
  EXPECT_EQ(run_title(record), "Smoke, Proposed, released");
  record.scenario.structure.file.path = "/meshes/of others/a340.obj";
  EXPECT_EQ(run_title(record), "Smoke (a340.obj), Proposed, released");
}

TEST_F(Record, AFolderHasItsOneName) {
  const fs::path before = fs::current_path();
  fs::create_directories(temp_.path() / "frames");
  fs::current_path(temp_.path());
  for (const fs::path& given :
       {fs::path("."), fs::path("./"), fs::path("frames/.."), temp_.path() / ""}) {
    EXPECT_EQ(read_run(given).folder, temp_.path()) << given;
  }
  fs::current_path(before);
}

TEST_F(Record, IsReadWithoutTheMeshFileThatMoved) {
  Scenario scenario = made_record().scenario;
  scenario.structure.file.path = (temp_.path() / "moved.ply").string();
  write("scenario.yaml", to_yaml(scenario));
  EXPECT_EQ(read_run(temp_.path()).scenario.structure.file.path, scenario.structure.file.path);
  EXPECT_THROW(load_scenario((temp_.path() / "scenario.yaml").string(), {}), BadInput);
}

TEST_F(Record, WhatIsMissingIsNamedWithTheCommandThatMakesIt) {
  ASSERT_EQ(read_run(temp_.path()).missing.size(), 1U);  // a made run has no summary
  remove("trajectory.tum");
  fs::rename(temp_.path() / "iterations.csv", temp_.path() / "iterations.csv.part");
  const RunRecord record = read_run(temp_.path());
  EXPECT_TRUE(record.path.empty());
  EXPECT_EQ(record.views.size(), 3U);  // of the journal
  EXPECT_FALSE(record.figures.has_value());
  ASSERT_EQ(record.missing.size(), 3U);
  for (const std::string& missing : record.missing)
    EXPECT_TRUE(says(missing, {"gnbv run", "--resume"}));
  fs::rename(temp_.path() / "iterations.csv.part", temp_.path() / "iterations.csv");
  write("summary.json", R"({"schema": 1, "profile_end_s": 2.0, "views_begin_s": 2.5})");
  const RunRecord older = read_run(temp_.path());
  EXPECT_EQ(older.views_begin_s, 2.5);
  EXPECT_TRUE(says(older.missing.back(), {"--update"}));
  remove("scenario.yaml");
  EXPECT_TRUE(refused("gnbv run SCENARIO"));
}

TEST_F(Record, WhoGoesOnWithARunKeepsWhatItKept) {
  const auto command = [&] { return command_to_resume(temp_.path()); };
  const auto has = [&](const char* option) { return command().find(option) != std::string::npos; };
  EXPECT_FALSE(has("--frames") || has("--candidates")) << command();
  fs::create_directories(temp_.path() / "frames");
  EXPECT_TRUE(has("--frames`") && !has("--candidates")) << command();
  write("candidates.jsonl.part", "");
  EXPECT_TRUE(has("--frames --candidates`")) << command();
  remove("frames");
  fs::rename(temp_.path() / "candidates.jsonl.part", temp_.path() / "candidates.jsonl");
  EXPECT_TRUE(has("--candidates`") && !has("--frames")) << command();
}

TEST_F(Record, WhatIsNoRunAndAPlaceThatIsNoneAreNamed) {
  write("summary.json", "{\"schema\": ");
  EXPECT_TRUE(refused("summary.json"));
  remove("summary.json");
  write("iterations.csv", iterations_csv(std::vector{made_view(0, {Vec3(0, -1e30, 1), 0.0}, 3)}));
  EXPECT_TRUE(refused("iterations.csv:2: stands at 0 -1e+30 1"));
  EXPECT_TRUE(says(fault_of([] { read_run(""); }), {"RUN: is empty"}));
  for (const float x : {std::numeric_limits<float>::quiet_NaN(), 1e30F}) {
    write_made_run(temp_.path());
    std::vector<Vec3f> points(6, Vec3f(0, 0, 1));
    points[4].x() = x;
    write_cloud_ply(points, temp_.path() / "cloud.ply");
    EXPECT_TRUE(refuses_cloud("cloud.ply: point 4"));
  }
}

TEST_F(Record, BetweenSamplesThePoseIsInterpolated) {
  RunRecord record = made_record();
  const auto p_world_m = [&](double time_s) {
    const auto T_world_body = true_pose_at(record, time_s);
    return T_world_body ? Vec3(T_world_body->translation()) : Vec3(Vec3::Constant(-99.0));
  };
  EXPECT_TRUE(p_world_m(3.25).isApprox(Vec3(-4, 2, 2.25)));
  EXPECT_EQ(p_world_m(3.0), Vec3(-4, 4, 2));
  EXPECT_EQ(p_world_m(4.05), Vec3(-4, -4, 3)) << "it hovers where it ends";
  EXPECT_EQ(p_world_m(-0.08), Vec3(-4, -4, 1)) << "and where it begins";
  EXPECT_FALSE(true_pose_at(record, 4.2) || true_pose_at(record, -0.2));
  record.path[3].T_world_body.rotate(Eigen::AngleAxisd(deg_to_rad(170.0), Vec3::UnitZ()));
  record.path[4].T_world_body.rotate(Eigen::AngleAxisd(deg_to_rad(-170.0), Vec3::UnitZ()));
  const Eigen::AngleAxisd turn(true_pose_at(record, 3.25)->linear());
  EXPECT_NEAR(turn.angle(), deg_to_rad(175.0), 1e-9) << "the shorter way round";
}

TEST_F(Record, ACloudOfAnotherRunIsRefused) {
  write_cloud_ply(std::vector<Vec3f>(4, Vec3f(0, 0, 1)), temp_.path() / "cloud.ply");
  EXPECT_TRUE(refuses_cloud("files of two runs"));
  remove("cloud.ply");
  EXPECT_TRUE(refuses_cloud("--resume"));
}

TEST_F(Record, ImagesThatAreNotOfTheirCamerasSizeAreRefused) {
  write_made_frames(temp_.path());
  const FrameRecord frames = read_frames(temp_.path());
  const auto fault = [&](const auto& image, const fs::path& file, const auto& read) {
    write_png(image, file);
    return fault_of([&] { read(frames, 0); });
  };
  const RecordedFrame& frame = frames.frames[0];
  const Image colour{48, 64, std::vector<std::uint8_t>(3 * 64 * 48)};
  const GreyImage16 depth{48, 64, std::vector<std::uint16_t>(64 * 48)};
  EXPECT_EQ(read_colour(frames, 0).width_px + read_depth(frames, 0).width_px, 128);
  for (const std::string& said :
       {fault(colour, frame.colour, read_colour), fault(depth, frame.depth, read_depth)}) {
    EXPECT_TRUE(says(said, {"0.png", "48 x 64 px, but cameras.json says 64 x 48 px"}));
  }
}

TEST_F(Record, FramesHoldPosesAndIntrinsics) {
  EXPECT_FALSE(has_frames(temp_.path()));
  EXPECT_TRUE(refuses_frames("--frames"));
  for (const std::string name : {"poses.csv", "cameras.json"}) {
    write_made_frames(temp_.path());
    remove("frames/" + name);
    EXPECT_TRUE(has_frames(temp_.path()));
    EXPECT_TRUE(refuses_frames(name + ": is missing; `gnbv run"));
  }
  write_made_frames(temp_.path());
  const FrameRecord record = read_frames(temp_.path());
  ASSERT_EQ(record.frames.size(), 3U);
  EXPECT_EQ(record.cameras[0].cy_px, 24.0);
  EXPECT_EQ(record.frames[2].iteration, 2);
  EXPECT_EQ(record.frames[2].T_world_camera * Vec3(1, 0, 0), Vec3(5, 4, 2));
  EXPECT_EQ(record.frames[2].depth, temp_.path() / "frames/depth_2.png");
}

}  // namespace
}  // namespace gnbv
