// The decision as a whole: which sampler, which view, and when there is none.
#include "planner/next_view.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "planner/follow_route.hpp"
#include "tests/planner/wall_world.hpp"

namespace gnbv {
namespace {

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
  ViewChecker checker(model.config.validity, model.navigation_m, model.no_fly, belief.grid, {},
                      kCurrent);
  std::optional<ViewPose> best;
  double best_value = 0.0;
  for (const ViewPose& view : sample_agvs(model.config.agvs, kCurrent, 1.0)) {
    Candidate candidate{.view = view, .sampler = "agvs"};
    checker.check(candidate);
    if (candidate.rejected) continue;
    ViewStats stats = evaluate_view(belief.grid, belief.cloud, model.view_rays[0], view, marks);
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

TEST(PlanNextView, UnknownSpaceIsRefusedUnlessAllowed) {
  const auto plan_with = [](bool allow) {
    const PlannerModel model =
        model_with([&](PlannerConfig& c) { c.validity.allow_unknown = allow; });
    return full_plan(model, wall_ahead(model, [](const Vec3&) { return false; }), {});
  };
  const Plan refused = plan_with(false);
  EXPECT_FALSE(refused.next);
  for (const Candidate& c : refused.candidates) EXPECT_TRUE(c.rejected.has_value());
  const Plan allowed = plan_with(true);
  ASSERT_TRUE(allowed.next);
  for (const Candidate& c : allowed.candidates) EXPECT_NE(c.rejected, Rejection::not_free);
}

TEST(PlanNextView, GainsAreDiscountedAlongTheWayOrStraight) {
  // a post stands in the straight way of some views of the grid
  const auto plan_with = [](DistanceAlong distance) {
    const PlannerModel model = model_with([&](PlannerConfig& c) {
      c.agvs.step_m = 3.0;
      c.validity.path = PathCheck::astar;
      c.utility.distance = distance;
    });
    Belief belief = wall_ahead(model, everywhere);
    const GridGeometry& grid = belief.grid.geometry();
    ScanUpdate post;
    for (double z_m = 0.1; z_m < 8.0; z_m += 0.2) {
      post.occupied.push_back(grid.index_of(grid.key_of(Vec3(1.7, 0.1, z_m))));
    }
    for (int hits = 0; hits < 8; ++hits) belief.grid.apply(post);
    return full_plan(model, belief, {});
  };
  const Plan along_path = plan_with(DistanceAlong::path);
  const Plan straight = plan_with(DistanceAlong::straight);
  ASSERT_EQ(along_path.candidates.size(), straight.candidates.size());
  int around = 0;
  for (std::size_t i = 0; i < straight.candidates.size(); ++i) {
    const Candidate& c = straight.candidates[i];
    if (c.rejected) continue;
    const double straight_m = (c.view.p_world_m - kCurrent.p_world_m).norm();
    EXPECT_DOUBLE_EQ(c.score.distance, std::exp(-0.2 * straight_m));
    EXPECT_DOUBLE_EQ(along_path.candidates[i].score.distance, std::exp(-0.2 * c.path_m));
    if (c.path_m > straight_m + 0.01) ++around;
  }
  EXPECT_GT(around, 0);
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
