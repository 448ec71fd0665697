// Laws of films and snapshots: a mission at a moment of its flight.
#include <gtest/gtest.h>

#include <algorithm>

#include "sim/core/error.hpp"
#include "tests/tools/render/laid_out.hpp"
#include "tools/render/snapshots.hpp"

namespace gnbv {
namespace {

/// At one pace: without a profile from the ground on, and on to where it landed.
TEST(Film, GoesFromTakeOffToLanding) {
  MadeRun made;
  EXPECT_EQ(film_times_s(made.record, 5), (std::vector<double>{3.0, 3.5, 4.0, 4.5, 5.0}));
  EXPECT_TRUE(film_times_s({}, 5).empty());
  made.record.path.push_back(made_sample(8, {-4, -4, 0}));
  EXPECT_EQ(film_times_s(made.record, 2), (std::vector<double>{3.0, 8.0}));
  made.record.scenario.planner.profiling.method = ProfilingMethod::none;
  EXPECT_EQ(film_times_s(made.record, 2), (std::vector<double>{0.0, 8.0}));
  RunSource run = made.source();
  const RenderView view = view_of(kSnapshotFraming, run);
  const Picture picture = Snapshots(run, {}, view, false).picture_at(1.0, 9.0, view);
  EXPECT_EQ(picture.panels.at(0).scene.dots.at(0).points_m.size(), 2U);  // the profile's
  EXPECT_TRUE(picture.detail.starts_with("before the first view, ")) << picture.detail;
  EXPECT_EQ(picture.inset.width_px, 0);
}

TEST(Snapshots, AreEachNthViewAndTheLast) {
  using Iterations = std::vector<std::size_t>;
  EXPECT_EQ(snapshot_iterations(7, 3, 12), (Iterations{0, 3, 6}));
  EXPECT_EQ(snapshot_iterations(8, 3, 12), (Iterations{0, 3, 6, 7}));
  EXPECT_EQ(snapshot_iterations(4, 0, 12), (Iterations{0, 1, 2, 3}));
  EXPECT_EQ(snapshot_iterations(0, 3, 12), Iterations{});
  EXPECT_NEAR(static_cast<double>(snapshot_iterations(635, 0, 12).size()), 12.0, 2.0);
}

TEST(Snapshots, ShowWhatWasFlownAndSeenUpToTheView) {
  const MadeRun made;
  RunSource run(made.temp.path(), 1, [](double, const std::string&) {});
  const RenderView view = view_of(kSnapshotFraming, run);
  Snapshots snapshots(run, {}, view, false);
  const std::size_t seen[] = {3, 5, 6};  // made_record()
  for (std::size_t i = 0; i < 3; ++i) {
    const RenderScene scene = snapshots.picture(i, view).panels.at(0).scene;
    EXPECT_EQ(scene.dots.at(0).points_m.size(), seen[i]);
    const std::size_t sample = std::min<std::size_t>(3 + i, 4);  // views are taken at 3, 4, 5 s
    const Vec3f vehicle = run.record().path[sample].T_world_body.translation().cast<float>();
    EXPECT_LT((scene.tubes.at(0).points_m.back() - vehicle).norm(), 1e-5F);
    EXPECT_TRUE(std::any_of(scene.balls.begin(), scene.balls.end(), [&](const BallItem& ball) {
      return ball.casts_shadow && ball.centre_m == vehicle;
    }));
  }
}

TEST(Snapshots, SayWhatTheInsetIsAndWhatIsPale) {
  MadeRun made;
  made.record.views.back().time_s = 2000.0;
  RunSource run = made.source();
  const RenderView view = view_of(kSnapshotFraming, run);
  const Picture picture = Snapshots(run, {}, view, false).picture(2, view);
  EXPECT_FALSE(picture.inset_words.empty());
  EXPECT_NE(picture.detail.find("1,997 s"), std::string::npos) << picture.detail;
  EXPECT_TRUE(std::any_of(picture.legend.begin(), picture.legend.end(), [](const auto& item) {
    return item.colours == std::vector<Rgb>{looks::kStructure.rgb()} &&
           item.label == "not seen yet";
  }));
}

/// Wherever a view looks: its pyramid is in the picture, and the inset does not hide it.
TEST(Snapshots, PyramidsStayClearOfTheInset) {
  MadeRun made;
  RunRecord& record = made.record;
  for (const double turned_rad : {0.0, 1.6, 3.1, 4.7}) {
    for (ViewRecord& view : record.views) view.decision.view.yaw_rad += turned_rad;
    RunSource run = made.source();
    const RenderView view = view_of(kSnapshotFraming, run);
    Snapshots snapshots(run, {}, view, false);
    for (std::size_t i = 0; i < record.views.size(); ++i) {
      const Picture picture = snapshots.picture(i, view);
      const double inset_px = 0.25 * 1280 * picture.inset.height_px / picture.inset.width_px;
      for (FrustumItem frustum : picture.panels.at(0).scene.frusta) {
        frustum.T_world_camera = T_world_body(record.views[i].decision.view) *
                                 make_camera_model(record.scenario.cameras[0]).T_body_camera;
        for (const Vec3& corner_m : far_corners_m(frustum)) {
          const Vec3 p_px = project(view, corner_m).value();
          EXPECT_TRUE(is_within(view, corner_m));
          EXPECT_FALSE(p_px.x() > 940 && p_px.y() < inset_px + 18 + 22) << p_px.transpose();
        }
      }
    }
  }
}

/// However far the cameras see: beside a small structure they see far beyond it.
TEST(Snapshots, TheFollowingCameraShowsVehicleAndStructureFromNear) {
  MadeRun made;
  RunRecord& record = made.record;
  for (CameraConfig& camera : record.scenario.cameras) camera.range_max_m = 40.0;
  record.path.clear();  // its views alone: a path of few samples would be smoothed beyond them
  RunSource run = made.source();
  Snapshots snapshots(run, {}, view_of(kSnapshotFraming, run), true);
  const Box3 structure_m = bounds_m(run.world().structure);
  for (std::size_t i = 0; i < record.views.size(); ++i) {
    const RenderView view = snapshots.view(i);
    const Vec3 vehicle_m = record.views[i].decision.view.p_world_m;
    EXPECT_TRUE(is_within(view, vehicle_m) && is_within(view, structure_m.center()));
    EXPECT_LT(
        project(view, vehicle_m)->z(),
        2.0 * std::max((vehicle_m - structure_m.center()).norm(), structure_m.diagonal().norm()));
  }
}

TEST(Snapshots, VehicleIsBetweenSamplesWhereTheViewIs) {
  MadeRun made;
  RunRecord& record = made.record;
  record.views[1].time_s = 4.25;  // samples at 4 s and 5 s would be half a second off
  record.path.push_back(made_sample(5, {-4, 0, 3}));
  RunSource run = made.source();
  const RenderView view = view_of(kSnapshotFraming, run);
  const RenderScene scene = Snapshots(run, {}, view, false).picture(1, view).panels.at(0).scene;
  EXPECT_TRUE(std::any_of(scene.balls.begin(), scene.balls.end(), [&](const BallItem& ball) {
    return ball.casts_shadow && (ball.centre_m - Vec3f(-4, -3, 3)).norm() < 1e-5F;
  }));
}

}  // namespace
}  // namespace gnbv
