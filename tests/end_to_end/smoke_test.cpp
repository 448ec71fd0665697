// The smoke mission through the library: every real component, a few seconds.
#include <gtest/gtest.h>

#include <fstream>

#include "bench/score/mission_score.hpp"
#include "bench/score/surface_reference.hpp"
#include "sim/core/error.hpp"
#include "tests/support/flown.hpp"
#include "tests/support/temp_folder.hpp"
#include "tests/support/watch.hpp"
#include "tools/mission/start_pose.hpp"
#include "tools/run/iterations_csv.hpp"
#include "tools/run/run_directory.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

/// One test, since each of its own would fly the mission again.
TEST(SmokeMission, EndsAsStatedNearItsPathAndItsCloudGrowsOnTheStructure) {
  const Flown f(smoke());
  const MissionResult& result = f.result;
  EXPECT_EQ(result.termination, Termination::max_iterations);
  EXPECT_EQ(result.legs_timed_out, 0);
  EXPECT_EQ(static_cast<int>(result.views.size()), f.scenario.planner.termination.max_iterations);
  EXPECT_GE(result.distance.flown_m, 0.9 * result.distance.straight_m);
  EXPECT_LE(result.distance.flown_m, 1.3 * result.distance.straight_m);
  std::size_t before = result.profile_points_world_m.size();
  EXPECT_GT(before, 0U);
  for (const ViewRecord& view : result.views) {
    EXPECT_GE(view.cloud_points, before) << view.iteration;
    before = view.cloud_points;
  }
  EXPECT_GT(before, 2 * result.profile_points_world_m.size());
  // a leaf's centroid lies within the leaf, off a curved or folded surface by less than its
  // diagonal
  const double limit_m = f.scenario.planner.cloud.profile_leaf_m * std::sqrt(3.0);
  for (const Vec3f& point : result.belief.cloud.points_world_m()) {
    ASSERT_LT(f.scene.distance_to_structure_m(point.cast<double>(), 1.0), limit_m)
        << point.transpose();
  }
}

TEST(SmokeMission, CoversMostOfTheStructureAndWhatExactSensorsCoverIsAccurate) {
  // of leaves that are smaller than a voxel: the centroid of one that holds an edge lies off it
  const Flown f(smoke({"planner.cloud.leaf_m=0.02"}));
  const SurfaceReference reference =
      make_surface_reference(f.world, f.scene, {.floor_z_m = f.scenario.planner.floor_z_m}, 2);
  const MissionScore score = score_cloud(reference, f.scene, scored_cloud(f.scenario, f.result),
                                         f.scenario.planner.map.resolution_m, 2);
  EXPECT_GT(score.final[0], std::max(0.9, 2 * score.profile[0]));
  EXPECT_GT(score.final[2], 0.9);
  for (std::size_t size = 0; size < kCoverageSizes_m.size(); ++size) {
    EXPECT_GE(score.final[size], score.profile[size]);
    EXPECT_NEAR(score.accurate[size], score.final[size], 0.001) << size;
    EXPECT_EQ(score.curve.accurate.back()[size], score.accurate[size]);
  }
  // a record without energy, as older versions wrote it, has none of a score
  ASSERT_EQ(score.curve.energy_wh.size(), score.curve.coverage.size());
  EXPECT_EQ(score.curve.energy_wh.front(), f.result.views.front().energy_wh);
  EXPECT_TRUE(std::ranges::is_sorted(score.curve.energy_wh));
  ScoredCloud older = scored_cloud(f.scenario, f.result);
  older.views.back().energy_wh.reset();
  const MissionScore unknown =
      score_cloud(reference, f.scene, older, f.scenario.planner.map.resolution_m, 2);
  EXPECT_FALSE(is_known(unknown.curve, Effort::wh_with_profile));
  EXPECT_TRUE(unknown.curve.on_one_battery.empty());
}

TEST(SmokeMission, AnotherSeedIsAnotherMission) {
  const RayScene scene(world_of(smoke()));
  EXPECT_NE(start_pose(smoke({"seed=2"}), scene).p_world_m, start_pose(smoke(), scene).p_world_m);
}

TEST(SmokeMission, TheIdealVehicleFliesExactlyThePlannedLegs) {
  const Flown ideal(smoke({"vehicle.kind=ideal"}));
  EXPECT_EQ(ideal.result.termination, Termination::max_iterations);
  // summed tick by tick: rounding only
  EXPECT_NEAR(ideal.result.distance.flown_m, ideal.result.distance.straight_m, 1e-6);
}

/// Asked to stop once `stop_after` views of its own were flown. Only its journal stays, as of one
/// that was killed.
MissionResult fly_into(const fs::path& folder, bool resume, std::size_t stop_after) {
  RunDirectory directory(folder, smoke(), resume);
  std::size_t views = 0;
  Watch watch;
  watch.view = [&](const ViewRecord& view, const Belief&) {
    directory.append(view);
    ++views;
  };
  const MissionInputs inputs = {.observers = {&watch},
                                .should_stop = [&] { return views >= stop_after; },
                                .replay = directory.recorded_decisions()};
  return Flown(smoke(), inputs).result;
}

TEST(ResumedMission, LosesNoRecordedViewWhenItIsStoppedEarly) {
  TempFolder temp;
  const fs::path folder = temp.path() / "run";
  fly_into(folder, false, 5);
  EXPECT_EQ(fly_into(folder, true, 2).views.size(), 5U);
  EXPECT_EQ(read_view_records(folder / "iterations.csv.part").size(), 5U);
}

TEST(ResumedMission, FliesWhatWasRecordedAndDoesNotPlanItAgain) {
  // the second view is turned by hand: planning anew would not choose it
  const std::vector<ViewRecord> views = Flown(smoke()).result.views;
  std::vector<Decision> recorded = {views[0].decision, views[1].decision};
  recorded[1].view.yaw_rad = wrap_angle_rad(recorded[1].view.yaw_rad + 0.1);
  const Flown flight(smoke({"planner.termination.max_iterations=2"}), {.replay = recorded});
  EXPECT_EQ(flight.result.views[1].decision.view.yaw_rad, recorded[1].view.yaw_rad);
}

TEST(ResumedMission, RefusesAnotherConfigurationAndANewRunInItsPlace) {
  TempFolder temp;
  const fs::path folder = temp.path() / "run";
  const RunDirectory first(folder, smoke(), false);
  EXPECT_THROW(RunDirectory(folder, smoke(), false), BadInput);
  EXPECT_THROW(RunDirectory(folder, smoke({"seed=9"}), true), BadInput);
}

TEST(Journal, LosesOnlyTheHalfWrittenLine) {
  TempFolder temp;
  const fs::path csv = temp.path() / "iterations.csv.part";
  std::vector<ViewRecord> views = Flown(smoke()).result.views;
  const std::string text = iterations_csv(views);
  std::ofstream(csv) << text.substr(0, text.size() - 10);
  views.pop_back();
  EXPECT_EQ(iterations_csv(read_view_records(csv)), iterations_csv(views));
}

}  // namespace
}  // namespace gnbv
