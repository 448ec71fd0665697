// The decision as a whole: which sampler, which view, and when there is none.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "planner/route/route_planners.hpp"
#include "sim/core/error.hpp"
#include "tests/planner/wall_world.hpp"

namespace gnbv {
namespace {

std::optional<Decision> plan(const SmallPlanner& planner, const Belief& belief,
                             const History& history = {}, int threads = 2) {
  const Plan made = planner.plan(belief, history, threads);
  return made.has_view() ? std::optional(made.next()) : std::nullopt;
}

TEST(PlanNextView, FindsNothingInAnUnknownWorldNorWhereNoSurfaceIsInSight) {
  const SmallPlanner planner;
  Belief belief(planner.model());
  EXPECT_FALSE(plan(planner, belief));
  clear(belief.grid, voxels_where(belief.grid, everywhere));
  EXPECT_FALSE(plan(planner, belief));
}

TEST(PlanNextView, TakesLargerStepsWhereNoneNearbyIsValid) {
  const SmallPlanner planner;
  // unmeasured within 2 m: all of scale 1 (at most sqrt 3 m) and none of the corners of scale 1.5
  const Belief belief =
      wall_ahead(planner, [](const Vec3& p_m) { return (p_m - kCurrent.p_world_m).norm() > 2.0; });
  History turned;  // where it is, where it may always be, every view is taken
  for (const ViewPose& view : sample_agvs(planner.config.agvs, kCurrent, 1.0)) {
    if (view.p_world_m == kCurrent.p_world_m) turned.decisions.push_back({.view = view});
  }
  const std::optional<Decision> decision = plan(planner, belief, turned);
  ASSERT_TRUE(decision);
  EXPECT_EQ(decision->scale, 1.5);
}

TEST(PlanNextView, TriesTheFinestGridBeforeGivingUpAndLearnsNothingFromTheStart) {
  // known within 2 m only, so that no view of the larger scales is valid, but for turns in place
  const SmallPlanner planner([](PlannerConfig& c) { c.agvs.rotation_at_all_scales = false; });
  const Belief near =
      wall_ahead(planner, [](const Vec3& p_m) { return (p_m - kCurrent.p_world_m).norm() < 2.0; });
  const Belief all = wall_ahead(planner, everywhere);
  const auto scale = [&](const Belief& belief, Sampler sampler, double last) {
    History history;
    history.decisions.assign(3, {.view = {Vec3(3, 3, 3), 0}, .sampler = sampler, .scale = last});
    return plan(planner, belief, history)->scale;
  };
  EXPECT_EQ(scale(near, Sampler::agvs, 3.0), 1.0);
  EXPECT_EQ(scale(all, Sampler::start, 1.0), 1.0);
  EXPECT_EQ(scale(all, Sampler::agvs, 1.0), 1.5);
}

TEST(PlanNextView, UnknownSpaceIsRefusedUnlessAllowed) {
  const auto plan_with = [](bool allow) {
    const SmallPlanner planner([&](PlannerConfig& c) { c.validity.allow_unknown = allow; });
    return planner.plan(wall_ahead(planner, [](const Vec3&) { return false; }), {});
  };
  const Plan refused = plan_with(false);
  for (const Candidate& c : refused.candidates) {  // but where the vehicle is
    EXPECT_TRUE(c.rejected.has_value() || c.view.p_world_m == kCurrent.p_world_m);
  }
  const Plan allowed = plan_with(true);
  ASSERT_TRUE(allowed.has_view());
  for (const Candidate& c : allowed.candidates) EXPECT_NE(c.rejected, Rejection::not_free);
}

TEST(PlanNextView, GainsAreDiscountedAlongTheWayOrStraight) {
  // a post stands in the straight way of some views of the grid
  const auto plan_with = [](DistanceAlong distance) {
    const SmallPlanner planner([&](PlannerConfig& c) {
      c.agvs.step_m = 3.0;
      c.validity.path = PathCheck::astar;
      c.utility.distance = distance;
    });
    Belief belief = wall_ahead(planner, everywhere);
    fill(belief.grid, Box3(Vec3(1.6, 0, 0), Vec3(1.8, 0.2, 8)));
    return planner.plan(belief, {});
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

TEST(PlanNextView, ChoosesTheFirstBestOfTheCandidatesThatAreNotRejected) {
  const SmallPlanner planner;
  const Plan plan = planner.plan(wall_ahead(planner, everywhere), {});
  EXPECT_EQ(plan.candidates.size(), 81U);
  const std::size_t chosen = plan.chosen.front();
  EXPECT_EQ(plan.candidates[chosen].view.p_world_m, plan.next().view.p_world_m);
  int valid = 0;
  for (std::size_t i = 0; i < plan.candidates.size(); ++i) {
    const Candidate& c = plan.candidates[i];
    if (c.rejected) continue;
    ++valid;
    EXPECT_LE(c.score.value, plan.next().score.value);
    EXPECT_TRUE(i >= chosen || c.score.value < plan.next().score.value) << i;
  }
  EXPECT_EQ(valid, plan.next().valid);
}

TEST(LaidRoute, TakesViewAfterViewAndSkipsWhatIsNotValid) {
  const SmallPlanner small;
  const Belief belief = wall_ahead(small, everywhere);
  const PlannerModel model = small.model();
  static const std::array route = {ViewPose{Vec3(-3, 0, 4), 0.0}, ViewPose{Vec3(6.1, 0, 4), 0.0},
                                   ViewPose{Vec3(3, 0, 4), 0.0}};  // the second is in the wall
  const auto lay = [](const OccupancyGrid&, const ViewPose&) {
    return std::vector<ViewPose>(route.begin(), route.end());
  };
  RoutePlanner planner({.lay = lay}, model);
  planner.begin(belief, kCurrent);
  Scratch scratch(model, 2);
  History history;
  const auto follow = [&] { return planner.next(belief, history, kCurrent, scratch); };
  const Plan first = follow();
  ASSERT_TRUE(first.has_view());
  EXPECT_EQ(first.next().view.p_world_m, route[0].p_world_m);
  EXPECT_EQ(first.next().sampler, Sampler::route);
  history.decisions.push_back(first.next());
  const Plan second = follow();
  ASSERT_TRUE(second.has_view());
  EXPECT_EQ(second.next().view.p_world_m, route[2].p_world_m);
  EXPECT_EQ(second.chosen, std::vector<std::size_t>{1});
  EXPECT_TRUE(second.candidates.front().rejected.has_value());
  history.decisions.push_back(second.next());
  EXPECT_FALSE(follow().has_view());  // the route is over
  // flown again, it goes on where the record ends, and refuses a record of another route
  planner.begin(belief, kCurrent);
  const std::vector<Decision> recorded = {first.next(), second.next()};
  for (const Decision& decision : recorded) {
    EXPECT_TRUE(is_same_view(
        planner.replay({&decision, 1}, belief, {}, kCurrent, scratch).next().view, decision.view));
  }
  EXPECT_FALSE(follow().has_view());
  EXPECT_THROW(planner.replay(recorded, belief, {}, kCurrent, scratch), BadInput);
}

TEST(Plan, CountsAViewThatWasCheckedTwiceByWhatWasFoundLast) {
  const ViewPose here{Vec3(1, 2, 3), 0.5};
  const ViewPose there{Vec3(1, 2, 4), 0.5};
  const auto rejected = [](const ViewPose& view, std::optional<Rejection> reason) {
    return Candidate{.view = view, .sampler = Sampler::fvs, .rejected = reason};
  };
  Plan plan;
  plan.candidates = {rejected(here, Rejection::path_blocked),
                     rejected(there, Rejection::path_blocked),
                     rejected(here, Rejection::cluster_hidden), rejected(there, std::nullopt)};
  const std::map<Rejection, int> once = {{Rejection::cluster_hidden, 1}};
  EXPECT_EQ(rejections_of(plan), once);
}

TEST(Planner, EndsItsWorkWhereSomebodyWantsItToStop) {
  for (const std::string_view name : planner_names()) {
    const SmallPlanner small([&](PlannerConfig& c) { c.utility.name = name; });
    const PlannerTraits traits = traits_of(small.config);
    if (!traits.scores_views && !traits.makes_tours) continue;  // what is laid or given is no work
    const Belief belief = wall_ahead(small, everywhere);
    const PlannerModel model = small.model();
    Scratch scratch(model, 2);
    scratch.should_stop = [] { return true; };
    EXPECT_THROW(make_planner(small.config, model)->next(belief, {}, kCurrent, scratch),
                 StopRequested)
        << name;
  }
}

TEST(LookAgain, IsAViewFromHereWhereNoneHasAUtilityAndTheScaleGrows) {
  // far from the wall, looking away from it
  const ViewPose away{Vec3(-7.5, 0.1, 4.1), kPi};
  for (const bool looks_again : {false, true}) {
    const SmallPlanner small([&](PlannerConfig& c) {
      c.agvs.look_again = looks_again;
      c.fvs.enabled = false;
      c.agvs.scale_max = 1.5;
    });
    const Belief belief = thin_wall_ahead(small);
    const Plan plan = small.plan(belief, {}, 2, away);
    ASSERT_EQ(plan.has_view(), looks_again);
    EXPECT_TRUE(small.plan(belief, {}).next().score.value > 0.0) << "in sight of the wall";
    if (!looks_again) continue;
    const Decision& again = plan.next();
    EXPECT_TRUE(is_same_view(again.view, away));
    EXPECT_EQ(again.score.value, 0.0);
    EXPECT_EQ(again.scale, 1.0);
    EXPECT_EQ(again.candidates, 82);
    EXPECT_EQ(plan.candidates.size(), 82U);
    History history;
    history.decisions.assign(3, again);
    EXPECT_EQ(small.plan(belief, history, 2, away).next().scale, 1.5);
  }
}

}  // namespace
}  // namespace gnbv
