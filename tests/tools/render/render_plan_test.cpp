// Laws of the picture of a tour's plan: it shows the views that are to come, and what was seen and
// flown by then.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "sim/core/file.hpp"
#include "tests/support/flown.hpp"
#include "tests/tools/render/laid_out.hpp"
#include "tools/run/cloud_file.hpp"
#include "tools/run/file_names.hpp"
#include "tools/scene/flight.hpp"

namespace gnbv {
namespace {

/// A tour around the smoke test's structure, with what of its files the picture needs.
struct FlownTour {
  FlownTour()
      : flown(smoke({"planner.utility.name=tour", "planner.termination.max_iterations=6"})),
        run({.folder = temp.path(),
             .scenario = flown.scenario,
             .path = flown.result.trajectory,
             .views = flown.result.views},
            flown.world) {
    const MissionResult& result = flown.result;
    write_file_atomically(temp.path() / kPlanFile, plan_jsonl(result.tour_plans));
    write_cloud_ply(result.belief.cloud.points_world_m(), temp.path() / kCloudFile);
    write_cloud_ply(result.profile_points_world_m, temp.path() / kProfileCloudFile);
  }

  TempFolder temp;
  Flown flown;
  RunSource run;
};

TEST(PlanPicture, ShowsWhatIsToComeAmongWhatWasSeen) {
  FlownTour tour;
  const RunRecord& record = tour.run.record();
  ASSERT_EQ(record.views.size(), 6U);
  for (const int after : {0, 2, 4}) {
    PictureOptions options;
    options.iteration = after;
    const RenderView view = view_of(kPlanPicture, tour.run, options);
    const Picture picture = kPlanPicture.draw(tour.run, options, view);
    const RenderScene& scene = picture.panels.at(0).scene;
    const ViewRecord& here = record.views[static_cast<std::size_t>(after)];
    EXPECT_EQ(scene.dots.at(0).points_m.size(), here.cloud_points);
    const auto standing =
        standing_plan(tour.flown.result.tour_plans, record, static_cast<std::size_t>(after));
    ASSERT_FALSE(standing->views().empty());
    // people count views from 1
    const auto n = static_cast<std::size_t>(after);
    EXPECT_TRUE(picture.detail.starts_with("after " + views_so_far(record, n) + ": "));
    EXPECT_TRUE(picture.legend.back().label.ends_with(
        fmt::format("when view {} was planned", standing->made->iteration + 1)));
    EXPECT_EQ(scene.balls.size(), 1 + standing->views().size());  // the vehicle, and each view
    EXPECT_EQ(scene.surfaces.at(0).mesh.vertices_m.size(), 8 * standing->made->plan.cubes.size());
    // the pyramid of the next view is the one that it had when it was flown
    const ViewPose& next = record.views[static_cast<std::size_t>(after) + 1].decision.view;
    const Isometry T_world_camera =
        frustum_of(record.scenario.cameras.at(0), T_world_body(next), 0.0, 1.0, {}).T_world_camera;
    EXPECT_TRUE(std::any_of(scene.frusta.begin(), scene.frusta.end(), [&](const FrustumItem& f) {
      return f.T_world_camera.isApprox(T_world_camera, 1e-4);
    })) << after;
    // as far as it was flown, and on from there
    EXPECT_TRUE(std::any_of(scene.tubes.begin(), scene.tubes.end(), [&](const TubeItem& tube) {
      return tube.points_m.front() == here.decision.view.p_world_m.cast<float>();
    }));
    for (const ViewPose& planned : standing->views()) {
      EXPECT_TRUE(is_within(view, planned.p_world_m));
    }
  }
}

TEST(PlanPicture, RunsThatAreNoToursAreRefused) {
  FlownTour tour;
  RunRecord other = tour.run.record();
  other.scenario.planner.utility.name = "proposed";
  RunSource run(other, tour.flown.world);
  std::vector<Vec3> points;
  EXPECT_TRUE(test::says(test::fault_of([&] { kPlanPicture.frame(run, {}, points); }),
                         {"was flown by proposed"}));
}

}  // namespace
}  // namespace gnbv
