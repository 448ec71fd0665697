// What the planner's options do to a whole mission: the smoke one, a second or so each.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "planner/core/belief.hpp"
#include "planner/guided/utility.hpp"
#include "sim/core/file.hpp"
#include "tests/support/flown.hpp"
#include "tests/support/temp_folder.hpp"
#include "tests/support/watch.hpp"
#include "tools/mission/decision_log.hpp"
#include "tools/run/decision_lines.hpp"

namespace gnbv {
namespace {

TEST(PlannerMission, EveryUtilityFliesWithoutACollision) {
  std::vector<std::string_view> names = utility_names();
  const auto laid = planners_that(&PlannerTraits::lays_views);
  names.insert(names.end(), laid.begin(), laid.end());
  EXPECT_GE(names.size(), 17U);
  std::set<std::string> hashes;
  for (const std::string_view name : names) {
    const Flown flight(smoke(
        {fmt::format("planner.utility.name={}", name), "planner.termination.max_iterations=5"}));
    EXPECT_NE(flight.result.termination, Termination::collision) << name;
    EXPECT_GE(flight.result.views.size(), 2U) << name;
    EXPECT_EQ(flight.result.views.back().decision.sampler == Sampler::route,
              traits_of(flight.scenario.planner).lays_views)
        << name;
    EXPECT_TRUE(hashes.insert(result_sha256(flight.result)).second) << name << " flies as another";
  }
}

TEST(PlannerMission, ASavedProfileIsTakenUpWhereItEnded) {
  // the ideal vehicle stands still where it is, however it came there
  const TempFolder folder;
  const std::filesystem::path file = folder.path() / "profile.map";
  Watch watch;
  watch.profile_belief = [&](const Belief& belief) { write_belief(belief, file); };
  const Flown flown(smoke({"vehicle.kind=ideal"}), {.observers = {&watch}});
  const Flown saved(smoke({"vehicle.kind=ideal", "planner.profiling.method=saved",
                           fmt::format("planner.profiling.file='{}'", file.string())}));
  EXPECT_EQ(saved.result.distance.profile_m, 0.0);
  EXPECT_EQ(saved.result.entropy_after_profile_nat, flown.result.entropy_after_profile_nat);
  ASSERT_EQ(saved.result.views.size(), flown.result.views.size());
  for (std::size_t i = 0; i < saved.result.views.size(); ++i) {
    const ViewRecord& a = saved.result.views[i];
    const ViewRecord& b = flown.result.views[i];
    EXPECT_EQ(a.decision.view.p_world_m, b.decision.view.p_world_m) << i;
    EXPECT_EQ(a.cloud_points, b.cloud_points) << i;
    EXPECT_EQ(a.entropy_nat, b.entropy_nat) << i;
  }
}

TEST(PlannerMission, TheCircularProfileSeesTheStructure) {
  const Flown circle(
      smoke({"planner.profiling.method=circular", "planner.termination.max_iterations=1"}));
  EXPECT_NE(circle.result.termination, Termination::collision);
  EXPECT_GT(circle.result.profile_points_world_m.size(), 100U);
}

TEST(PlannerMission, FliesByThePointsOnTheWay) {
  const Scenario scenario = smoke({"planner.termination.max_iterations=2"});
  const Flown straight(scenario);
  std::vector<Decision> recorded;
  for (const ViewRecord& view : straight.result.views) recorded.push_back(view.decision);
  const Vec3 from_m = recorded[0].view.p_world_m;
  const Vec3 via_m = from_m + Vec3(0.0, 0.0, 1.0);
  recorded[1].via_world_m = {via_m};
  const Flown around(scenario, {.replay = recorded});
  const double way_m = 1.0 + (recorded[1].view.p_world_m - via_m).norm();
  EXPECT_NEAR(around.result.distance.straight_m, way_m, 0.05);  // from where the profile left it
  EXPECT_NEAR(around.result.distance.flown_m, way_m, 0.1);
  double nearest_m = 1e9;
  for (const TrajectorySample& sample : around.result.trajectory) {
    if (sample.time_s < around.result.views[0].time_s) continue;
    nearest_m = std::min(nearest_m, (sample.T_world_body.translation() - via_m).norm());
  }
  EXPECT_LT(nearest_m, scenario.guidance.arrival_distance_m);
}

TEST(CandidatesFile, HasEachCandidateOnceAndOneChosenADecision) {
  const TempFolder folder;
  CandidatesFile file(folder.path(), 0);
  Watch watch;
  watch.plan = [&](const auto&... all) { file.write(all...); };
  const Flown flown(smoke({"planner.termination.max_iterations=6", "planner.fvs.mode=single"}),
                    {.observers = {&watch}});
  file.finish();
  std::istringstream lines(read_file(folder.path() / "candidates.jsonl"));
  std::vector<int> chosen(6, 0);
  std::vector<int> all(6, 0);
  for (std::string line; std::getline(lines, line);) {
    const auto json = nlohmann::json::parse(line);
    const auto iteration = json["iteration"].get<std::size_t>();
    ++all.at(iteration);
    EXPECT_NE(json.contains("rejected"), json.contains("utility"));
    chosen.at(iteration) += json.value("chosen", false) ? 1 : 0;
  }
  EXPECT_EQ(chosen, (std::vector<int>{0, 1, 1, 1, 1, 1}));
  for (std::size_t i = 1; i < all.size(); ++i) EXPECT_GE(all[i], 12) << i;
}

/// A smoke mission that writes beliefs.jsonl, and by the iteration of its first view each plan of
/// which it tells, with what the planner counted of that view by the same belief.
struct Believed {
  std::vector<BelievedVoxels> views;
  std::map<std::size_t, ViewStats> counted;
  std::map<std::size_t, Plan> plans;
  std::string sha256;

  explicit Believed(const std::vector<std::string>& overrides) {
    const TempFolder folder;
    const Scenario scenario = smoke(overrides);
    const PlannerModel model = planner_model(scenario);
    const Belief* belief = nullptr;
    Watch watch;
    watch.view = [&](const ViewRecord&, const Belief& now) { belief = &now; };
    watch.plan = [&](std::size_t iteration, const Plan& plan) {
      if (!plan.has_view()) return;
      VisitMarks marks(belief->grid.geometry().voxel_count());
      const ViewPose& view = plan.next().view;
      counted[iteration] = evaluate_view(belief->grid, belief->cloud,
                                         model.rays_at(view.gimbal_pitch_rad), view, marks);
      plans[iteration] = plan;
    };
    DecisionLog log(scenario, folder.path(), 0);
    const Flown flown(scenario, {.observers = {&watch, &log}});
    log.finish();
    sha256 = result_sha256(flown.result);
    views = read_beliefs(folder.path(), flown.result.views.size(), model.geometry().voxel_count());
  }
};

TEST(BeliefLog, HasTheVoxelsThatThePlannerCounted) {
  const Believed believed({});
  for (const auto& [i, counted] : believed.counted) {
    if (believed.plans.at(i).views.size() > 1) continue;
    EXPECT_EQ(voxel_count(believed.views.at(i).unknown), counted.unknown_voxels) << i;
  }
  EXPECT_GT(voxel_count(believed.views.at(1).unknown), 0U);
}

TEST(BeliefLog, HasThePredictedVoxelsThatRaysMeetFirstAndTheClusterThatWasLookedAt) {
  const PlannerModel model = planner_model(smoke());
  Belief belief(model);
  const std::size_t count = belief.grid.geometry().voxel_count();
  for (VoxelIndex v = 0; v < count; v += 3) belief.grid.predict(v);
  Plan plan;
  plan.views = {{.view = {Vec3(0, 0, 2), 0.5}}};
  plan.candidates = {{.view = plan.next().view, .sampler = Sampler::fvs, .cluster = 1}};
  plan.chosen = {0};
  plan.clusters = {{.voxels = {3, 4}}, {.voxels = {7, 9}}};  // in whatever order they were tried
  const BelievedVoxels voxels = believed_voxels(model, belief, plan);
  VisitMarks visits(count);
  const ViewStats counted =
      evaluate_view(belief.grid, belief.cloud, model.rays_at(0.0), plan.next().view, visits);
  EXPECT_EQ(voxel_count(voxels.predicted), counted.predicted_voxels);
  EXPECT_EQ(voxel_count(voxels.unknown), counted.unknown_voxels);
  EXPECT_GT(counted.predicted_voxels, 0U);
  EXPECT_EQ(voxels.looked_at, runs_of(plan.clusters[1].voxels));
  // of a burst all that its views were for
  plan.views.push_back({.view = {Vec3(1, 0, 2), 0.9}});
  plan.candidates.push_back({.view = plan.views[1].view, .sampler = Sampler::fvs, .cluster = 0});
  plan.chosen = {0, 1};
  const BelievedVoxels of_burst = believed_voxels(model, belief, plan);
  std::set<VoxelIndex> unknown;
  for (const Decision& next : plan.views) {
    const VoxelsInSight seen = voxels_in_sight(belief.grid, model.rays_at(0.0), next.view);
    unknown.insert(seen.unknown.begin(), seen.unknown.end());
  }
  EXPECT_GT(unknown.size(), voxel_count(voxels.unknown));
  EXPECT_EQ(of_burst.unknown, runs_of(std::vector(unknown.begin(), unknown.end())));
  EXPECT_EQ(voxel_count(of_burst.looked_at), 4U);
}

TEST(BeliefLog, HasFrontiersWhereViewsWereSampledAroundThem) {
  const std::vector<std::string> stuck = {"planner.fvs.entropy_threshold_nat=1",
                                          "planner.fvs.entropy_window=1"};
  const Believed believed(stuck);
  EXPECT_EQ(believed.sha256, result_sha256(Flown(smoke(stuck)).result));  // it changes nothing
  std::size_t looked = 0;
  std::size_t bursts = 0;
  for (const auto& [i, plan] : believed.plans) {
    const auto& [unknown, predicted, frontier, looked_at] = believed.views.at(i);
    EXPECT_EQ(!looked_at.empty(), plan.candidates.at(plan.chosen.at(0)).cluster >= 0) << i;
    EXPECT_EQ(frontier, runs_of(plan.frontier)) << i;
    EXPECT_GE(voxel_count(frontier), voxel_count(looked_at)) << i;
    looked += voxel_count(looked_at);
    bursts += plan.is_burst() ? 1 : 0;
  }
  EXPECT_GT(looked, 0U);
  EXPECT_GT(bursts, 0U);
}

}  // namespace
}  // namespace gnbv
