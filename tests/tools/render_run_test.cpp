// Laws of the pictures of runs: what the files say is what is drawn, and bad files are named.
#include <gtest/gtest.h>

#include "tests/support/made_run.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/render/run_picture.hpp"

namespace gnbv {
namespace {

class RunPicture : public ::testing::Test {
 protected:
  RunPicture() {
    cube_.vertices_m = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0},
                        {-1, -1, 2}, {1, -1, 2}, {1, 1, 2}, {-1, 1, 2}};
    cube_.faces = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                   {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  }

  TempFolder temp_;
  RunRecord record_ = made_record();
  TriangleMesh cube_;
};

TEST_F(RunPicture, ProfileFlightIsGreyAndPlannedFlightRunsThroughTheRamp) {
  const RunPictureOptions options;
  const RenderView view = run_view(record_, cube_, options);
  const RenderScene scene = run_scene(record_, cube_, options, view);
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
  record_.views_begin_s = {};
  const RenderView view = run_view(record_, cube_, {});
  EXPECT_EQ(run_scene(record_, cube_, {}, view).tubes.size(), 1U);
}

TEST_F(RunPicture, DenseStraightFlightDrawsAsItsEnds) {
  record_.path.clear();
  for (int i = 0; i <= 1000; ++i) record_.path.push_back(made_sample(i, {0.01 * i, 0, 5}));
  record_.views_begin_s = {};
  const RenderScene scene = run_scene(record_, cube_, {}, run_view(record_, cube_, {}));
  ASSERT_EQ(scene.tubes.size(), 1U);
  // colours need a point each 1/150 of the way
  EXPECT_LT(scene.tubes[0].points_m.size(), 180U);
  EXPECT_EQ(scene.tubes[0].points_m.back(), Vec3f(10, 0, 5));
}

TEST_F(RunPicture, PictureHasTheSizeAskedForAndRepeats) {
  RunPictureOptions options;
  options.width_px = 480;
  options.height_px = 270;
  render_run(record_, cube_, options, temp_.path() / "a.png");
  render_run(record_, cube_, options, temp_.path() / "b.png");
  const Image image = read_png(temp_.path() / "a.png");
  EXPECT_EQ(image.width_px, 480);
  EXPECT_EQ(image.height_px, 270);
  EXPECT_EQ(read_file(temp_.path() / "a.png"), read_file(temp_.path() / "b.png"));
  // too small for a caption, and still a picture
  options.width_px = 40;
  options.height_px = 30;
  render_run(record_, cube_, options, temp_.path() / "c.png");
  EXPECT_EQ(read_png(temp_.path() / "c.png").height_px, 30);
}

}  // namespace
}  // namespace gnbv
