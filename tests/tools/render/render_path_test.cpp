// Laws of the picture of a flight.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/tools/render/laid_out.hpp"
#include "tools/scene/flight.hpp"

namespace gnbv {
namespace {

RenderScene path_scene(RunSource& run, const PictureOptions& options) {
  return scene_of(kPathPicture, run, options);
}

/// Its views are taken where the flight passes them.
RunRecord record_in_time() {
  RunRecord record = made_record();
  for (ViewRecord& view : record.views) view.time_s -= 1.0;
  return record;
}

TEST(PathPicture, ProfileFlightIsGreyAndPlannedFlightRunsThroughTheRamp) {
  RunSource run(record_in_time(), cube());
  const RenderScene scene = path_scene(run, {.has_profile = true});
  ASSERT_EQ(scene.tubes.size(), 2U);
  EXPECT_EQ(scene.tubes[0].colours.size(), 1U);
  EXPECT_EQ(scene.tubes[0].points_m.front(), Vec3f(-4, -4, 1));
  EXPECT_EQ(scene.tubes[0].points_m.back(), Vec3f(4, 4, 1));  // the flights touch
  EXPECT_EQ(scene.tubes[1].points_m.front(), Vec3f(4, 4, 1));
  EXPECT_EQ(scene.tubes[1].points_m.back(), Vec3f(-4, -4, 3));
  EXPECT_EQ(scene.tubes[1].colours.front(), path_ramp(0.0));
  EXPECT_EQ(scene.tubes[1].colours.back(), path_ramp(1.0));
  EXPECT_EQ(scene.balls.size(), 3U);  // the views
  EXPECT_EQ(scene.frusta.size(), 3U * run.record().scenario.cameras.size());
  EXPECT_EQ(path_scene(run, {}).tubes.size(), 1U);  // the profile is left out
}

/// Views that follow each other at once would part a colour of metres from one of views.
TEST(PathPicture, TheFlightHasTheColourOfTheViewsThatItPasses) {
  RunRecord record = record_in_time();
  record.path = {made_sample(0, {0, 0, 1}), made_sample(2, {0, 0, 2}), made_sample(3, {0, 0, 3}),
                 made_sample(4, {0, 0, 20})};
  record.views = {made_view(0, {Vec3(0, 0, 2), 0.0}, 3), made_view(1, {Vec3(0, 0, 3), 0.0}, 5),
                  made_view(2, {Vec3(0, 0, 20), 0.0}, 6)};
  for (ViewRecord& view : record.views) view.time_s -= 1.0;
  RunSource run(record, cube());
  const RenderScene scene = path_scene(run, {});
  ASSERT_EQ(scene.tubes.size(), 1U);
  for (const BallItem& view : scene.balls) {
    const TubeItem& flight = scene.tubes.front();
    const auto at = std::find(flight.points_m.begin(), flight.points_m.end(), view.centre_m);
    ASSERT_NE(at, flight.points_m.end());
    EXPECT_EQ(flight.colours[static_cast<std::size_t>(at - flight.points_m.begin())], view.colour);
  }
}

/// However much lies before them.
TEST(PathPicture, StartAndEndAreMarkedOverEverything) {
  RunSource run(made_record(), cube());
  const RenderView view = view_of(kPathPicture, run);
  const Panel panel = kPathPicture.draw(run, {}, view).panels.at(0);
  ASSERT_EQ(panel.lines.size(), 2U);
  ASSERT_EQ(panel.labels.size(), 2U);
  const std::vector<ViewRecord>& views = run.record().views;
  EXPECT_EQ(panel.lines[0].from_world_m, views.front().decision.view.p_world_m);
  EXPECT_EQ(panel.lines[1].from_world_m, views.back().decision.view.p_world_m);
  EXPECT_EQ(panel.labels[1].text, "end");
}

TEST(PathPicture, PyramidsLookWhereTheViewDoes) {
  const RunRecord record = made_record();
  const FrustumItem frustum =
      frustum_of(CameraConfig{}, T_world_body(record.views[1].decision.view), 0.0, 1.0, {});
  EXPECT_NEAR(frustum.T_world_camera.linear().col(2).x(), std::cos(1.5), 1e-12);
  // on a gimbal as low as that view had it, fixed at its own pitch
  CameraConfig camera;
  camera.pitch_rad = 0.1;
  const auto down = [&] {
    return -frustum_of(camera, Isometry::Identity(), 0.4, 1.0, {}).T_world_camera(2, 2);
  };
  EXPECT_NEAR(down(), std::sin(0.1), 1e-12);
  camera.gimbal = GimbalConfig{};
  EXPECT_NEAR(down(), std::sin(0.4), 1e-12);
}

/// A camera that is mounted off the body hangs on a line from its view.
TEST(PathPicture, PyramidsBesideTheirViewsHangOnALine) {
  RunRecord record = made_record();
  const std::size_t all = record.views.size() * record.scenario.cameras.size();
  const auto lines = [&](double below_m) {
    for (CameraConfig& camera : record.scenario.cameras) camera.p_body_m = Vec3(0, 0, -below_m);
    RunSource run(record, cube());
    return path_scene(run, {}).tubes;
  };
  EXPECT_EQ(lines(0.0).size(), 1U);  // the flight
  const auto hung = lines(2.0);
  ASSERT_EQ(hung.size(), 1U + all);
  EXPECT_NEAR((hung.back().points_m.front() - hung.back().points_m.back()).norm(), 2.0, 1e-5);
}

/// Without a summary the whole flight is of one kind.
TEST(PathPicture, DenseStraightFlightDrawsAsItsEnds) {
  RunRecord record = made_record();
  record.path.clear();
  for (int i = 0; i <= 1000; ++i) record.path.push_back(made_sample(i, {0.01 * i, 0, 5}));
  record.views_begin_s = {};
  RunSource run(record, cube());
  const RenderScene scene = path_scene(run, {.has_profile = true});
  ASSERT_EQ(scene.tubes.size(), 1U);
  // colours need a point each 1/150 of the way
  EXPECT_LT(scene.tubes[0].points_m.size(), 180U);
  EXPECT_EQ(scene.tubes[0].points_m.back(), Vec3f(10, 0, 5));
}

/// What was made of the run, where its structure would be, and in its own colours.
TEST(PathPicture, RunsAroundAnotherSurfaceOnRequest) {
  RunSource run(made_record(), cube());
  PictureOptions options;
  double piece_m = 0.0;
  options.surface = [&](RunSource& of, double asked_m) {
    EXPECT_EQ(&of, &run);
    piece_m = asked_m;
    SurfaceItem item;
    item.mesh.vertices_m = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    item.mesh.faces = {{0, 1, 2}};
    return item;
  };
  const RenderView view = view_of(kPathPicture, run, options);
  const RenderScene scene = path_scene(run, options);
  EXPECT_NEAR(piece_m * px_per_m_at_focus(view), 2.0, 1e-9);
  ASSERT_EQ(scene.surfaces.size(), 1U);
  EXPECT_EQ(scene.surfaces.front().mesh.faces.size(), 1U);
  EXPECT_FALSE(scene.paint.has_value());
  EXPECT_TRUE(scene.ground.has_value());
  EXPECT_TRUE(path_scene(run, {}).paint.has_value());
}

}  // namespace
}  // namespace gnbv
