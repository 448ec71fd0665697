// Laws of the pictures of runs: what the files say is what is drawn, and bad files are named.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/render/run_picture.hpp"

namespace gnbv {
namespace {

class RunPicture : public ::testing::Test {
 protected:
  void SetUp() override {
    dir_ = std::filesystem::temp_directory_path() / fmt::format("gnbv_run_picture_{}", ::getpid());
    std::filesystem::create_directories(dir_);
    write("trajectory.tum",
          "# time x y z qx qy qz qw\n"
          "0.0 -4 -4 1 0 0 0 1\n1.0 4 -4 1 0 0 0 1\n2.0 4 4 1 0 0 0 1\n"
          "3.0 -4 4 2 0 0 0 1\n4.0 -4 -4 3 0 0 0 1\n");
    write("iterations.csv",
          "iteration,utility,yaw,x,y,z\n1,0.5,3.0,4,4,1\n2,0.4,1.5,-4,4,2\n3,0.3,0.8,-4,-4,3\n");
    write("summary.json",
          R"({"scenario": "cube", "utility": "proposed", "iterations": 3, "views_begin_s": 2.0,
              "distance_m": {"flown": 31.0}, "coverage": {"final": {"0.05": 0.941}}})");
    cube_.vertices_m = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0},
                        {-1, -1, 2}, {1, -1, 2}, {1, 1, 2}, {-1, 1, 2}};
    cube_.faces = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                   {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  }
  void TearDown() override { std::filesystem::remove_all(dir_); }

  void write(const std::string& name, const std::string& content) const {
    write_file_atomically(dir_ / name, content);
  }
  // The message of the error that reading the run ends in.
  std::string complaint() const {
    try {
      read_run(dir_);
    } catch (const BadInput& error) {
      return error.what();
    }
    return "";
  }

  std::filesystem::path dir_;
  TriangleMesh cube_;
};

TEST_F(RunPicture, FilesAreReadByColumnName) {
  const RunRecord record = read_run(dir_);
  ASSERT_EQ(record.path.size(), 5U);
  EXPECT_EQ(record.path[3].time_s, 3.0);
  EXPECT_EQ(record.path[3].p_world_m, Vec3(-4, 4, 2));
  ASSERT_EQ(record.views.size(), 3U);
  EXPECT_EQ(record.views[1].p_world_m, Vec3(-4, 4, 2));
  EXPECT_EQ(record.views[1].yaw_rad, 1.5);
  EXPECT_EQ(record.views_begin_s, 2.0);
  EXPECT_EQ(record.title, "cube, proposed");
  EXPECT_EQ(record.detail, "3 views, 31.0 m, coverage 94.1 % at 0.05 m");
}

TEST_F(RunPicture, ProfileFlightIsGreyAndPlannedFlightRunsThroughTheRamp) {
  const RunRecord record = read_run(dir_);
  const RunPictureOptions options;
  const RenderView view = run_view(record, cube_, options);
  const RenderScene scene = run_scene(record, cube_, options, view);
  ASSERT_EQ(scene.tubes.size(), 2U);
  EXPECT_EQ(scene.tubes[0].colours.size(), 1U);
  EXPECT_EQ(scene.tubes[0].points_m.front(), Vec3f(-4, -4, 1));
  EXPECT_EQ(scene.tubes[0].points_m.back(), Vec3f(4, 4, 1));  // the flights touch
  EXPECT_EQ(scene.tubes[1].points_m.front(), Vec3f(4, 4, 1));
  EXPECT_EQ(scene.tubes[1].points_m.back(), Vec3f(-4, -4, 3));
  EXPECT_EQ(scene.tubes[1].colours.front(), path_ramp(0.0));
  EXPECT_EQ(scene.tubes[1].colours.back(), path_ramp(1.0));
  EXPECT_EQ(scene.balls.size(), 3U);
  EXPECT_EQ(scene.frusta.size(), 3U);
  // the pyramid looks where the view does: optical z is the body's x
  EXPECT_NEAR(scene.frusta[1].T_world_camera.linear().col(2).x(), std::cos(1.5), 1e-12);
}

TEST_F(RunPicture, WithoutSummaryTheWholeFlightIsOfOneKind) {
  std::filesystem::remove(dir_ / "summary.json");
  const RunRecord record = read_run(dir_);
  EXPECT_FALSE(record.views_begin_s.has_value());
  const RenderView view = run_view(record, cube_, {});
  EXPECT_EQ(run_scene(record, cube_, {}, view).tubes.size(), 1U);
}

TEST_F(RunPicture, DenseStraightFlightDrawsAsItsEnds) {
  std::string rows;
  for (int i = 0; i <= 1000; ++i) rows += fmt::format("{} {} 0 5 0 0 0 1\n", i, 0.01 * i);
  write("trajectory.tum", rows);
  std::filesystem::remove(dir_ / "summary.json");
  const RunRecord record = read_run(dir_);
  const RenderScene scene = run_scene(record, cube_, {}, run_view(record, cube_, {}));
  ASSERT_EQ(scene.tubes.size(), 1U);
  // colours need a point each 1/150 of the way
  EXPECT_LT(scene.tubes[0].points_m.size(), 180U);
  EXPECT_EQ(scene.tubes[0].points_m.back(), Vec3f(10, 0, 5));
}

TEST_F(RunPicture, PictureHasTheSizeAskedForAndRepeats) {
  RunPictureOptions options;
  options.width_px = 480;
  options.height_px = 270;
  render_run(dir_, cube_, options, dir_ / "a.png");
  render_run(dir_, cube_, options, dir_ / "b.png");
  const Image image = read_png(dir_ / "a.png");
  EXPECT_EQ(image.width_px, 480);
  EXPECT_EQ(image.height_px, 270);
  EXPECT_EQ(read_file(dir_ / "a.png"), read_file(dir_ / "b.png"));
  // too small for a caption, and still a picture
  options.width_px = 40;
  options.height_px = 30;
  render_run(dir_, cube_, options, dir_ / "c.png");
  EXPECT_EQ(read_png(dir_ / "c.png").height_px, 30);
}

TEST_F(RunPicture, MissingFilesAreNamedWithTheCommandThatWritesThem) {
  for (const char* name : {"trajectory.tum", "iterations.csv"}) {
    const std::string content = read_file(dir_ / name);
    std::filesystem::remove(dir_ / name);
    EXPECT_NE(complaint().find((dir_ / name).string()), std::string::npos);
    EXPECT_NE(complaint().find("gnbv run"), std::string::npos);
    write(name, content);
  }
  EXPECT_EQ(complaint(), "");
}

TEST_F(RunPicture, DamagedFilesAreNamedWithTheLine) {
  write("trajectory.tum", "0 1 2 3 0 0 0 1\n1 1 2 three 0 0 0 1\n");
  EXPECT_NE(complaint().find("trajectory.tum:2"), std::string::npos) << complaint();
  write("trajectory.tum", "0 1 2 3 0 0 0\n");
  EXPECT_NE(complaint().find("trajectory.tum:1"), std::string::npos) << complaint();
  write("trajectory.tum", "0 1 2 3 0 0 0 1\n1 nan 2 3 0 0 0 1\n");
  EXPECT_NE(complaint().find("trajectory.tum:2"), std::string::npos) << complaint();
  write("trajectory.tum", "1 1 2 3 0 0 0 1\n0 1 2 3 0 0 0 1\n");
  EXPECT_NE(complaint().find("goes back"), std::string::npos) << complaint();
  write("trajectory.tum", "");
  EXPECT_NE(complaint().find("holds no pose"), std::string::npos) << complaint();
  write("trajectory.tum", "0 1 2 3 0 0 0 1\n");
  write("iterations.csv", "iteration,x,y,yaw\n");
  EXPECT_NE(complaint().find("`z`"), std::string::npos) << complaint();
  write("iterations.csv", "x,y,z,yaw\n1,2,3,0\n1,2\n");
  EXPECT_NE(complaint().find("iterations.csv:3"), std::string::npos) << complaint();
  write("iterations.csv", "x,y,z,yaw\n");
  EXPECT_EQ(complaint(), "");
  write("summary.json", "{\"scenario\": ");
  EXPECT_NE(complaint().find("summary.json"), std::string::npos) << complaint();
  write("summary.json", "{\"scenario\": 3}");
  EXPECT_NE(complaint().find("summary.json"), std::string::npos) << complaint();
}

}  // namespace
}  // namespace gnbv
