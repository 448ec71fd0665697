// Laws of pictures for which a mission is flown again: they show what the mission believed.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tests/tools/render/laid_out.hpp"
#include "tests/tools/render/watched.hpp"
#include "tools/mission/replay.hpp"
#include "tools/run/decision_lines.hpp"
#include "tools/scene/voxels.hpp"

namespace gnbv {
namespace {

bool same_belief(const Belief& a, const Belief& b) {
  const auto same = [](auto x, auto y) {
    return std::equal(x.begin(), x.end(), y.begin(), y.end());
  };
  return same(a.grid.all_log_odds(), b.grid.all_log_odds()) &&
         same(a.grid.words(), b.grid.words()) &&
         same(a.cloud.points_world_m(), b.cloud.points_world_m());
}

bool same_plan(const Plan& a, const Plan& b) {
  return a.chosen == b.chosen &&
         std::equal(a.candidates.begin(), a.candidates.end(), b.candidates.begin(),
                    b.candidates.end(), [](const Candidate& x, const Candidate& y) {
                      return x.view.p_world_m == y.view.p_world_m &&
                             x.view.yaw_rad == y.view.yaw_rad && x.sampler == y.sampler &&
                             x.scale == y.scale && x.cluster == y.cluster &&
                             x.rejected == y.rejected && x.path_m == y.path_m &&
                             x.score.value == y.score.value;
                    });
}

TEST(Replay, BelievesAndPlansInOneFlightWhatTheMissionDid) {
  const ReplayRequest request{
      .waypoints = {1}, .has_profile = true, .belief = kAsked + 1, .decision = kAsked};
  const Replayed all = replay(watched().recorded(), request);
  EXPECT_TRUE(same_belief(*all.belief, watched().beliefs[kAsked + 1]));
  EXPECT_TRUE(same_belief(all.decision->belief, watched().beliefs[kAsked - 1]));
  EXPECT_FALSE(same_belief(watched().beliefs[kAsked - 1], watched().beliefs[kAsked]));
  EXPECT_TRUE(same_plan(all.decision->plan, watched().plans.at(kAsked)));  // the start is none
  const std::vector<std::size_t> waypoints = {1};
  const auto alone = replay_profile(watched().recorded(), waypoints);
  ASSERT_EQ(all.profile.size(), alone.size());
  for (std::size_t i = 0; i < alone.size(); ++i) {
    EXPECT_EQ(all.profile[i].points_world_m, alone[i].points_world_m);
    EXPECT_EQ(all.profile[i].waypoints_world_m.size(), all.profile[i].waypoints);
  }
}

TEST(Replay, RefusesAnotherMissionsRecord) {
  std::vector<ViewRecord> views = watched().flown.result.views;
  ++views[1].cloud_points;
  RecordedMission mission = watched().recorded();
  mission.views = views;
  EXPECT_THROW(replay(mission, {.belief = kAsked}), BadInput);
  // told to who asks, not to who flies ahead
  const Flown& flown = watched().flown;
  RunSource run(RunRecord{.folder = {}, .scenario = flown.scenario, .views = views}, flown.world);
  run.expect({.belief = kAsked});
  EXPECT_NO_THROW(run.fly_ahead());
  EXPECT_THROW(run.belief_after(kAsked), BadInput);
}

TEST(Replay, ProfileEndsAsTheMissionsDid) {
  const std::size_t waypoints[] = {1, 3, 8};
  const auto stages = replay_profile(watched().recorded(), waypoints);
  ASSERT_EQ(stages.size(), 3U);
  EXPECT_EQ(stages[2].points_world_m, watched().flown.result.profile_points_world_m);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(stages[i].waypoints, waypoints[i]);
  EXPECT_LT(stages[0].path_world_m.size(), stages[1].path_world_m.size());
  EXPECT_LT(stages[1].path_world_m.size(), stages[2].path_world_m.size());
}

TEST(Replay, CircularProfileEndsAsTheMissionsDid) {
  Watched circular(
      smoke({"planner.profiling.method=circular", "planner.profiling.circle_stations=4",
             "planner.termination.max_iterations=1"}));
  const std::size_t waypoints[] = {1, 3, 8};
  const auto stages = replay_profile(circular.recorded(), waypoints);
  ASSERT_EQ(stages.size(), 3U);  // stations, not the climbs at them; each number once
  EXPECT_EQ(stages[0].waypoints, 1U);
  EXPECT_EQ(stages[1].waypoints, 3U);
  EXPECT_EQ(stages[2].waypoints, 4U);
  EXPECT_EQ(stages[2].points_world_m, circular.flown.result.profile_points_world_m);
  // up there at the end of the first station: nothing is left to see
  EXPECT_GT(stages[0].path_world_m.back().z(), stages[0].path_world_m.front().z());
}

TEST(Replay, ProfileNeedsNoViewsEvenOfAnOracle) {
  const Scenario scenario =
      smoke({"planner.utility.name=oracle_views", "planner.profiling.method=circular",
             "planner.profiling.circle_stations=1"});
  const Flown& flown = watched().flown;
  const std::size_t waypoints[] = {1, 3};
  const auto stages = replay_profile(
      {.scenario = scenario, .world = flown.world, .scene = flown.scene, .views = {}}, waypoints);
  ASSERT_EQ(stages.size(), 1U);
  EXPECT_EQ(stages[0].waypoints, 1U);
  EXPECT_FALSE(stages[0].points_world_m.empty());
}

void write_candidates(const Watched& of, const std::filesystem::path& folder) {
  CandidatesFile file(folder, 1);
  for (const auto& [iteration, plan] : of.plans) file.write(iteration, plan);
  file.finish();
}

/// A decision that is read, or planned again where the run kept no candidates, has the clusters
/// that it tried: of bursts those that were not tried before. Any view of a burst has that of its
/// first.
void expect_clusters(const Watched& stuck, bool has_candidates) {
  const TempFolder temp;
  if (has_candidates) write_candidates(stuck, temp.path());
  const Flown& flown = stuck.flown;
  std::size_t compared = 0;
  for (std::size_t i = 1; i < flown.result.views.size(); ++i) {
    const Plan& made = stuck.plan_of(i);
    if (made.clusters.empty()) continue;  // its grid was asked alone
    RunSource run{{.folder = temp.path(), .scenario = flown.scenario, .views = flown.result.views},
                  flown.world};
    const ReplayedDecision& again = run.decision(i);
    EXPECT_EQ(again.plan.chosen, made.chosen);
    EXPECT_EQ(again.plan.frontier, made.frontier);
    EXPECT_EQ(again.belief.grid.total_entropy_nat(),
              flown.result.views[flown.result.views[i].planned_at() - 1].entropy_nat);
    ASSERT_EQ(again.plan.clusters.size(), made.clusters.size());
    for (std::size_t k = 0; k < made.clusters.size(); ++k) {
      EXPECT_EQ(again.plan.clusters[k].voxels, made.clusters[k].voxels);
    }
    compared += made.clusters.size();
  }
  EXPECT_GT(compared, 1U);
}

TEST(RunSource, ADecisionHasTheClustersThatItTried) {
  expect_clusters(Watched(smoke({"planner.termination.max_iterations=5", "planner.fvs.mode=single",
                                 "planner.fvs.order=largest", "planner.fvs.entropy_threshold_nat=1",
                                 "planner.fvs.entropy_window=1"})),
                  true);
  const Watched& bursts = watched_bursts();
  const std::vector<ViewRecord>& views = bursts.flown.result.views;
  EXPECT_TRUE(std::ranges::any_of(
      views, [](const ViewRecord& view) { return view.decision.plan_view > 1; }));
  for (const bool has_candidates : {true, false}) expect_clusters(bursts, has_candidates);
}

/// And the picture shows all of each, though cubes stick out of the structure.
TEST(VoxelsPicture, HoldsACubeForEachVoxelOfTheMap) {
  RunSource run = source();
  const PictureOptions options{.iteration = kAsked};
  const RenderView view = view_of(kVoxelsPicture, run, options);
  const RenderScene scene = kVoxelsPicture.draw(run, options, view).panels.at(0).scene;
  const OccupancyGrid& grid = watched().beliefs[kAsked].grid;
  ASSERT_EQ(scene.surfaces.size(), 3U);  // occupied, predicted, unknown
  EXPECT_EQ(scene.surfaces[0].mesh.faces.size(), 12U * grid.occupied_count());
  EXPECT_EQ(scene.surfaces[1].mesh.faces.size(), 12U * grid.predicted_count());
  const std::vector<Rgb> colour = {Rgb{}};
  for (const Vec3f& v : run.world().structure.vertices_m) {
    const VoxelIndex voxel =
        grid.geometry().index_of(grid.geometry().key_of(Vec3(v.cast<double>())));
    for (const Vec3f& corner_m :
         voxel_cubes(grid.geometry(), std::array{voxel}, colour).mesh.vertices_m) {
      EXPECT_TRUE(is_within(view, corner_m.cast<double>()));
    }
  }
}

/// Each panel shows the whole box and each waypoint that was flown by then, with its number on it.
TEST(ProfilePicture, FramesTheBoxAndNumbersTheWaypointsOnTheSpot) {
  RunSource run = source();
  const RenderView view = view_of(kProfilePicture, run);
  const Picture picture = kProfilePicture.draw(run, {}, view);
  const auto is_inside = [&](const Vec3& p_m) {
    const Vec3 p_px = project(view, p_m).value();
    const double badge_px = 8.5;
    return p_px.x() > badge_px && p_px.x() < view.width_px - badge_px && p_px.y() > badge_px &&
           p_px.y() < view.height_px - badge_px;
  };
  const Box3& box_m = run.record().scenario.workspace_m;
  for (int i = 0; i < 8; ++i) {
    EXPECT_TRUE(is_inside(box_m.corner(static_cast<Box3::CornerType>(i))));
  }
  ASSERT_EQ(picture.panels.size(), run.profile().size());
  for (std::size_t k = 0; k < picture.panels.size(); ++k) {
    const ProfileStage& stage = run.profile()[k];
    const std::vector<PlaceLabel>& labels = picture.panels[k].labels;
    ASSERT_EQ(labels.size(), stage.waypoints + 1);  // and where it started
    for (std::size_t i = 0; i < stage.waypoints; ++i) {
      EXPECT_EQ(labels[i + 1].text, std::to_string(i + 1));
      EXPECT_TRUE(labels[i + 1].badge.has_value());
      EXPECT_EQ(labels[i + 1].p_world_m, stage.waypoints_world_m[i]);
      EXPECT_TRUE(is_inside(labels[i + 1].p_world_m));
    }
  }
}

TEST(ProfilePicture, LinesTakeTheSameShareOfAnyPicture) {
  RunSource run = source();
  const auto share = [&](int times) {
    const PictureOptions options{.width_px = 1280 * times, .height_px = 720 * times};
    const RenderView view = view_of(kProfilePicture, run, options);
    const Picture picture = kProfilePicture.draw(run, options, view);
    const auto radius_m = static_cast<double>(picture.panels[0].scene.tubes.front().radius_m);
    return radius_m * px_per_m_at_focus(view) / options.width_px;
  };
  EXPECT_NEAR(share(3) / share(1), 1.0, 0.01);  // panels are of whole pixels
}

TEST(ProfilePicture, IsSeenFromAboveUnlessAnglesAreAskedFor) {
  RunSource run = source();
  const auto down = [&](const PictureKind& kind, const PictureOptions& options) {
    return -view_of(kind, run, options).T_world_camera(2, 2);
  };
  EXPECT_GT(down(kProfilePicture, {}), down(kPathPicture, {}) + 0.1);
  PictureOptions asked;
  asked.angles.emplace();
  EXPECT_NEAR(down(kProfilePicture, asked), down(kPathPicture, {}), 1e-9);
}

TEST(Replay, FlightAheadBringsBackWhatOneThatIsWaitedForDoes) {
  RunSource run = source();
  run.expect({.has_profile = true, .belief = kAsked + 1});
  run.fly_ahead();
  run.fly_ahead();  // once more changes nothing
  EXPECT_TRUE(same_belief(run.belief_after(kAsked + 1), watched().beliefs[kAsked + 1]));
  EXPECT_TRUE(same_belief(run.belief_after(kAsked), watched().beliefs[kAsked]));  // not expected
  EXPECT_EQ(
      run.profile().back().points_world_m,
      replay_profile(watched().recorded(), std::vector<std::size_t>{1}).back().points_world_m);
}

}  // namespace
}  // namespace gnbv
