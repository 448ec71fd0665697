// The decision as a whole: which sampler, which view, and when there is none.
#include "planner/next_view.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "planner/belief.hpp"
#include "planner/follow_route.hpp"
#include "planner/history.hpp"
#include "planner/model.hpp"
#include "planner/workbench.hpp"

namespace gnbv {
namespace {

const Box3 kWorkspace(Vec3(-8, -8, 0), Vec3(8, 8, 8));
const ViewPose kCurrent{Vec3(0.1, 0.1, 4.1), 0.0};

PlannerModel small_model() {
  PlannerConfig config;
  config.validity.collision_radius_m = 0.5;
  const CameraModel camera = make_camera_model({});
  return PlannerModel(config, kWorkspace, {&camera, 1}, {});
}

/// A wall at x = 6, all else free where `is_known` says so and unmeasured elsewhere.
template <typename IsKnown>
Belief wall_ahead(const PlannerModel& model, const IsKnown& is_known) {
  Belief belief(model);
  const GridGeometry& grid = belief.grid.geometry();
  ScanUpdate update;
  for (VoxelIndex v = 0; v < grid.voxel_count(); ++v) {
    const Vec3 center_m = grid.center_m(grid.key_at(v));
    if (std::fabs(center_m.x() - 6.1) < 0.05) {
      update.occupied.push_back(v);
    } else if (is_known(center_m)) {
      update.free.push_back(v);
    }
  }
  belief.grid.apply(update);
  return belief;
}

bool everywhere(const Vec3&) { return true; }

std::optional<Decision> plan(const PlannerModel& model, const Belief& belief,
                             const History& history = {}, int threads = 2) {
  Workbench bench(model, threads);
  return plan_next_view(model, belief, history, kCurrent, bench).next;
}

TEST(PlanNextView, FindsNothingInAnUnknownWorld) {
  const PlannerModel model = small_model();
  EXPECT_FALSE(plan(model, Belief(model)));
}

TEST(PlanNextView, FindsNothingWhereNoSurfaceIsInSight) {
  const PlannerModel model = small_model();
  Belief belief(model);
  ScanUpdate update;
  for (VoxelIndex v = 0; v < belief.grid.geometry().voxel_count(); ++v) update.free.push_back(v);
  belief.grid.apply(update);
  EXPECT_FALSE(plan(model, belief));
}

TEST(PlanNextView, ChoosesTheHighestUtilityAndTheFirstOfEquals) {
  const PlannerModel model = small_model();
  const Belief belief = wall_ahead(model, everywhere);
  const std::optional<Decision> decision = plan(model, belief);
  ASSERT_TRUE(decision);
  // the same search, written out
  VisitMarks marks(belief.grid.geometry().voxel_count());
  ViewChecker checker(model.config.validity, model.navigation_m, belief.grid, {}, kCurrent);
  std::optional<ViewPose> best;
  double best_value = 0.0;
  for (const ViewPose& view : sample_agvs(model.config.agvs, kCurrent, 1.0)) {
    Candidate candidate{.view = view, .sampler = "agvs"};
    checker.check(candidate);
    if (candidate.rejected) continue;
    ViewStats stats = evaluate_view(belief.grid, belief.cloud, model.view_rays, view, marks);
    stats.density_max = belief.cloud.density_max();
    stats.path_m = (view.p_world_m - kCurrent.p_world_m).norm();
    const auto utility = score(model.config.utility, stats);
    if (!utility || (best && utility->value <= best_value)) continue;
    best = view;
    best_value = utility->value;
  }
  ASSERT_TRUE(best);
  EXPECT_EQ(decision->view.p_world_m, best->p_world_m);
  EXPECT_EQ(decision->view.yaw_rad, best->yaw_rad);
  EXPECT_EQ(decision->score.value, best_value);
  EXPECT_EQ(decision->scale, 1.0);
}

TEST(PlanNextView, DoesNotDependOnTheNumberOfThreads) {
  const PlannerModel model = small_model();
  const Belief belief = wall_ahead(model, everywhere);
  const std::optional<Decision> one = plan(model, belief, {}, 1);
  for (const int threads : {2, 5}) {
    const std::optional<Decision> many = plan(model, belief, {}, threads);
    EXPECT_EQ(many->view.p_world_m, one->view.p_world_m);
    EXPECT_EQ(many->view.yaw_rad, one->view.yaw_rad);
    EXPECT_EQ(many->score.value, one->score.value);
  }
}

TEST(PlanNextView, TakesLargerStepsWhereNoneNearbyIsValid) {
  const PlannerModel model = small_model();
  // unmeasured within 2 m: all of scale 1 (at most sqrt 3 m) and none of the corners of scale 1.5
  const Belief belief =
      wall_ahead(model, [](const Vec3& p_m) { return (p_m - kCurrent.p_world_m).norm() > 2.0; });
  const std::optional<Decision> decision = plan(model, belief);
  ASSERT_TRUE(decision);
  EXPECT_EQ(decision->scale, 1.5);
}

TEST(PlanNextView, TriesTheFinestGridBeforeGivingUp) {
  const PlannerModel model = small_model();
  // known within 2 m only, so that no view of the larger scales is valid
  const Belief belief =
      wall_ahead(model, [](const Vec3& p_m) { return (p_m - kCurrent.p_world_m).norm() < 2.0; });
  History history;
  history.decisions.assign(3, {.view = {Vec3(3, 3, 3), 0}, .sampler = "agvs", .scale = 3.0});
  const std::optional<Decision> decision = plan(model, belief, history);
  ASSERT_TRUE(decision);
  EXPECT_EQ(decision->scale, 1.0);
}

TEST(PlanNextView, TheStartIsNoUtilityToLearnFrom) {
  const PlannerModel model = small_model();
  const Belief belief = wall_ahead(model, everywhere);
  History history;
  history.decisions.assign(3, {.view = {Vec3(3, 3, 3), 0}, .sampler = "start"});
  EXPECT_EQ(plan(model, belief, history)->scale, 1.0);
  history.decisions.assign(3, {.view = {Vec3(3, 3, 3), 0}, .sampler = "agvs"});
  EXPECT_EQ(plan(model, belief, history)->scale, 1.5);
}

/// The wall of `wall_ahead`, seen as a few points a voxel: all of it a frontier.
void sample_thinly(Belief& belief) {
  std::vector<Vec3f> points_m;
  const GridGeometry& grid = belief.grid.geometry();
  for (VoxelIndex v = 0; v < grid.voxel_count(); ++v) {
    if (belief.grid.state(v) != VoxelState::occupied) continue;
    points_m.push_back(grid.center_m(grid.key_at(v)).cast<float>());
  }
  belief.cloud.add(points_m, 0.02);
}

/// As after five views without any change.
History still_history() {
  History history;
  history.entropies_nat.assign(6, 1000.0);
  return history;
}

Plan full_plan(const PlannerModel& model, const Belief& belief, const History& history) {
  Workbench bench(model, 2);
  return plan_next_view(model, belief, history, kCurrent, bench);
}

PlannerModel model_with(const std::function<void(PlannerConfig&)>& change) {
  PlannerConfig config;
  config.validity.collision_radius_m = 0.5;
  change(config);
  const CameraModel camera = make_camera_model({});
  return PlannerModel(config, kWorkspace, {&camera, 1}, {});
}

TEST(PlanNextView, LooksAtTheNearestFrontierWhereEntropyStandsStill) {
  const PlannerModel model = small_model();
  Belief belief = wall_ahead(model, everywhere);
  sample_thinly(belief);
  const Plan at_minimum = full_plan(model, belief, still_history());
  ASSERT_TRUE(at_minimum.next);
  EXPECT_EQ(at_minimum.next->sampler, "fvs");
  // before the wall, at the cylinder's radius, looking at it
  EXPECT_NEAR(at_minimum.next->view.p_world_m.x(), 6.1 - 3.5, 1e-6);
  EXPECT_NEAR(at_minimum.next->view.yaw_rad, 0.0, 1e-9);
  EXPECT_EQ(full_plan(model, belief, {}).next->sampler, "agvs");  // and back
}

TEST(PlanNextView, FvsTriesOneClusterAfterTheOther) {
  // a lone frontier behind the view's back in a corner where no view is legal, nearer than the wall
  const PlannerModel model = small_model();
  Belief belief = wall_ahead(model, everywhere);
  sample_thinly(belief);
  const Plan plan = full_plan(model, belief, still_history());
  ASSERT_TRUE(plan.next);
  int best_rank = -1;
  for (const Candidate& c : plan.candidates) best_rank = std::max(best_rank, c.cluster);
  EXPECT_EQ(plan.candidates.size(), 12U * static_cast<std::size_t>(best_rank + 1));
  for (const Candidate& c : plan.candidates) {
    EXPECT_TRUE(c.cluster == best_rank || c.rejected.has_value());
  }
}

TEST(PlanNextView, FallsBackToTheGridWhenFvsFindsNothing) {
  Belief belief = wall_ahead(small_model(), everywhere);  // no points: no frontier
  const Plan fallback = full_plan(small_model(), belief, still_history());
  ASSERT_TRUE(fallback.next);
  EXPECT_EQ(fallback.next->sampler, "agvs");
  // the paper to the letter: the mission is over
  const PlannerModel literal = model_with([](PlannerConfig& c) { c.fvs.agvs_when_stuck = false; });
  EXPECT_FALSE(full_plan(literal, belief, still_history()).next);
}

TEST(PlanNextView, LiteralClustersAreOneAndItsCentroidMayBeUnreachable) {
  // frontiers all around the current position: cut, some cluster has a view; uncut, the centroid
  // is in the middle of a closed box and every view around it is inside or beyond the wall
  const auto in_shell = [](const Vec3& p_m) {
    const double distance_m = (p_m - Vec3(0.1, 0.1, 4.1)).cwiseAbs().maxCoeff();
    return distance_m > 2.9 && distance_m < 3.15;
  };
  const auto belief_of = [&](const PlannerModel& model) {
    Belief belief(model);
    ScanUpdate update;
    const GridGeometry& grid = belief.grid.geometry();
    for (VoxelIndex v = 0; v < grid.voxel_count(); ++v) {
      (in_shell(grid.center_m(grid.key_at(v))) ? update.occupied : update.free).push_back(v);
    }
    belief.grid.apply(update);
    sample_thinly(belief);
    return belief;
  };
  const PlannerModel cut = small_model();
  const PlannerModel uncut = model_with([](PlannerConfig& c) {
    c.fvs.frontier.max_extent_m = 0.0;
    c.fvs.agvs_when_stuck = false;
  });
  EXPECT_TRUE(full_plan(cut, belief_of(cut), still_history()).next);
  EXPECT_FALSE(full_plan(uncut, belief_of(uncut), still_history()).next);
}

TEST(PlanNextView, EveryCandidateIsEitherScoredOrRejectedForAReason) {
  const PlannerModel model = small_model();
  const Plan plan = full_plan(model, wall_ahead(model, everywhere), {});
  EXPECT_EQ(plan.candidates.size(), 80U);
  int valid = 0;
  for (const Candidate& c : plan.candidates) {
    if (c.rejected) continue;
    ++valid;
    EXPECT_LE(c.score.value, plan.next->score.value);
  }
  EXPECT_EQ(valid, plan.next->valid);
}

TEST(FollowRoute, TakesViewAfterViewAndSkipsWhatIsNotValid) {
  const PlannerModel model = small_model();
  const Belief belief = wall_ahead(model, everywhere);
  const ViewPose first{Vec3(-3, 0, 4), 0.0};
  const ViewPose in_the_wall{Vec3(6.1, 0, 4), 0.0};
  const ViewPose last{Vec3(3, 0, 4), 0.0};
  const std::array route = {first, in_the_wall, last};
  History history;
  const auto follow = [&] { return follow_route(model, belief, history, route, kCurrent); };
  const auto next = follow().next;
  ASSERT_TRUE(next);
  EXPECT_EQ(next->view.p_world_m, first.p_world_m);
  EXPECT_EQ(next->sampler, "route");
  history.decisions.push_back(*next);
  const Plan second = follow();
  ASSERT_TRUE(second.next);
  EXPECT_EQ(second.next->view.p_world_m, last.p_world_m);
  EXPECT_EQ(second.chosen, 1U);
  EXPECT_TRUE(second.candidates.front().rejected.has_value());
  history.decisions.push_back(*second.next);
  EXPECT_FALSE(follow().next);  // the route is over
}

}  // namespace
}  // namespace gnbv
