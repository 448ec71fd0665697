// Single frontier views at a local minimum: which clusters are looked at, and in which order.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/planner/wall_world.hpp"

namespace gnbv {
namespace {

/// A planner that answers one frontier view at a time.
SmallPlanner of_single_views(const std::function<void(PlannerConfig&)>& change = {}) {
  return SmallPlanner([&](PlannerConfig& c) {
    c.fvs.mode = FvsMode::single;
    set_mode_switches(c.fvs);
    if (change) change(c);
  });
}

TEST(FrontierViews, LooksAtTheNearestFrontierWhereEntropyStandsStill) {
  const SmallPlanner planner = of_single_views();
  const Belief belief = thin_wall_ahead(planner);
  const Plan at_minimum = planner.plan(belief, still_history());
  ASSERT_TRUE(at_minimum.has_view());
  EXPECT_EQ(at_minimum.next().sampler, Sampler::fvs);
  // before the wall, at the cylinder's radius, looking at it
  EXPECT_NEAR(at_minimum.next().view.p_world_m.x(), 6.1 - 3.5, 1e-6);
  EXPECT_NEAR(at_minimum.next().view.yaw_rad, 0.0, 1e-9);
  EXPECT_EQ(planner.plan(belief, {}).next().sampler, Sampler::agvs);  // and back
}

/// A wall ahead, all of it a frontier, and a lone frontier of five voxels at `lone_m`, nearer.
Belief wall_and_lone_frontier(const SmallPlanner& planner, const Vec3& lone_m,
                              const std::function<bool(const Vec3&)>& is_known) {
  Belief belief = wall_ahead(planner, is_known);
  for (int i = -2; i <= 2; ++i) {
    hit(belief.grid, {voxel_at(belief.grid, lone_m + Vec3(0, 0, 0.2 * i))});
  }
  sample_thinly(belief);
  return belief;
}

/// Frontiers all around the current position: a closed box of them, all else free.
Belief shell_of_frontiers(const SmallPlanner& planner) {
  const auto in_shell = [](const Vec3& p_m) {
    const double distance_m = (p_m - kCurrent.p_world_m).cwiseAbs().maxCoeff();
    return distance_m > 2.9 && distance_m < 3.15;
  };
  Belief belief(planner.model());
  clear(belief.grid, voxels_where(belief.grid, everywhere));
  hit(belief.grid, voxels_where(belief.grid, in_shell));
  sample_thinly(belief);
  return belief;
}

/// Where nothing but the frontiers' own views may be taken.
SmallPlanner model_with_fvs(const std::function<void(FvsConfig&)>& change) {
  return of_single_views([&](PlannerConfig& c) {
    c.fvs.agvs_when_stuck = false;
    change(c.fvs);
  });
}

TEST(FrontierViews, FvsTriesOneClusterAfterTheOther) {
  // all views of the lone frontier stand in unmeasured space; those of the wall do not
  const auto plan_with = [](int tries) {
    const SmallPlanner planner = model_with_fvs([&](FvsConfig& fvs) { fvs.tries = tries; });
    const Belief belief = wall_and_lone_frontier(planner, Vec3(-2.1, 0.1, 4.1),
                                                 [](const Vec3& p_m) { return p_m.x() > 2.0; });
    return planner.plan(belief, still_history());
  };
  const Plan one = plan_with(1);
  EXPECT_FALSE(one.has_view());
  ASSERT_EQ(one.candidates.size(), 12U);
  for (const Candidate& c : one.candidates) EXPECT_EQ(c.rejected, Rejection::not_free);
  for (const int tries : {2, 50}) {
    const Plan more = plan_with(tries);
    ASSERT_TRUE(more.has_view());
    ASSERT_EQ(more.candidates.size(), 24U);  // and no third cluster
    EXPECT_EQ(more.candidates[more.chosen.front()].cluster, 1);
    EXPECT_EQ(more.next().candidates, 12);
    EXPECT_NEAR(more.next().view.p_world_m.x(), 6.1 - 3.5, 1e-6);
  }
}

TEST(FrontierViews, FvsLeavesWhatWasLookedAtOftenEnough) {
  const SmallPlanner planner = model_with_fvs([](FvsConfig& fvs) { fvs.looks_max = 2; });
  const Belief belief = wall_and_lone_frontier(planner, Vec3(-2.1, 0.1, 4.1),
                                               [](const Vec3& p_m) { return p_m.x() > 2.0; });
  History history = still_history();
  const auto last_cluster = [&] {
    const Plan plan = planner.plan(belief, history);
    return plan.candidates.empty() ? -1 : plan.candidates.back().cluster;
  };
  EXPECT_EQ(last_cluster(), 1);  // the lone one has no valid view, the wall has
  // views of the lone frontier, from other sides and layers
  for (const double yaw_rad : {0.0, deg_to_rad(90.0)}) {
    const Vec3 back(-std::cos(yaw_rad), -std::sin(yaw_rad), 0.0);
    Decision decision;
    decision.sampler = Sampler::fvs;
    decision.view = {Vec3(-2.1, 0.1, 4.1) + planner.config.fvs.radius_m * back +
                         planner.config.fvs.layer_step_m * Vec3::UnitZ(),
                     yaw_rad};
    EXPECT_EQ(last_cluster(), 1);
    history.decisions.push_back(decision);
  }
  EXPECT_EQ(last_cluster(), 0);  // the wall is the only one left
  history.decisions.back().sampler = Sampler::agvs;
  EXPECT_EQ(last_cluster(), 1);  // a view of the grid is no look at a cluster
}

TEST(FrontierViews, PooledClustersCompeteAndOthersTakeTheirTurn) {
  // the lone frontier is nearer, the wall the better view
  const auto plan_with = [](bool pool) {
    const SmallPlanner planner = of_single_views([&](PlannerConfig& c) {
      c.utility.lambda_per_m = 0.0;
      c.fvs.pool_clusters = pool;
      c.fvs.tries = 2;
    });
    const Belief belief = wall_and_lone_frontier(planner, Vec3(-3.9, 0.1, 4.1), everywhere);
    return planner.plan(belief, still_history());
  };
  const Plan in_turn = plan_with(false);
  ASSERT_TRUE(in_turn.has_view());
  EXPECT_EQ(in_turn.candidates.size(), 12U);
  EXPECT_EQ(in_turn.candidates[in_turn.chosen.front()].cluster, 0);
  const Plan pooled = plan_with(true);
  ASSERT_TRUE(pooled.has_view());
  EXPECT_EQ(pooled.candidates.size(), 24U);
  EXPECT_EQ(pooled.next().candidates, 24);
  EXPECT_EQ(pooled.candidates[pooled.chosen.front()].cluster, 1);
  EXPECT_GT(pooled.next().score.value, in_turn.next().score.value);
  for (const Candidate& c : pooled.candidates) {
    EXPECT_TRUE(c.rejected || c.score.value <= pooled.next().score.value);
  }
}

TEST(FrontierViews, LargestClustersFirstIsASwitch) {
  const auto looked_at_from = [](ClusterOrder order) {
    const SmallPlanner planner = model_with_fvs([&](FvsConfig& fvs) {
      fvs.order = order;
      fvs.frontier.max_extent_m = 0.0;  // the wall is one cluster
    });
    const Belief belief = wall_and_lone_frontier(planner, Vec3(-3.9, 0.1, 4.1), everywhere);
    const Plan plan = planner.plan(belief, still_history());
    EXPECT_TRUE(plan.has_view());
    EXPECT_EQ(plan.candidates.size(), 12U);
    return plan.next().view.p_world_m.x();
  };
  EXPECT_LT(looked_at_from(ClusterOrder::nearest), 0.0);
  EXPECT_NEAR(looked_at_from(ClusterOrder::largest), 6.1 - 3.5, 1e-6);
}

TEST(FrontierViews, WithoutFrontierViewsEveryUtilityStaysOnTheGrid) {
  for (const char* name : {"proposed", "bircher", "isler"}) {
    const auto sampler = [&](bool has_fvs) {
      const SmallPlanner planner = of_single_views([&](PlannerConfig& c) {
        c.utility.name = name;
        c.fvs.enabled = has_fvs;
      });
      const Plan plan = planner.plan(thin_wall_ahead(planner), still_history());
      EXPECT_TRUE(plan.has_view()) << name;
      for (const Candidate& c : plan.candidates)
        EXPECT_EQ(c.sampler == Sampler::agvs, !has_fvs) << name;
      return plan.next().sampler;
    };
    EXPECT_EQ(sampler(false), Sampler::agvs) << name;
    EXPECT_EQ(sampler(true), Sampler::fvs) << name;
  }
}

TEST(FrontierViews, FallsBackToTheGridWhenFvsFindsNothing) {
  const SmallPlanner planner = of_single_views();
  const Belief belief = wall_ahead(planner, everywhere);  // no points: no frontier
  const Plan fallback = planner.plan(belief, still_history());
  ASSERT_TRUE(fallback.has_view());
  EXPECT_EQ(fallback.next().sampler, Sampler::agvs);
  // the paper to the letter: the mission is over
  const SmallPlanner literal =
      of_single_views([](PlannerConfig& c) { c.fvs.agvs_when_stuck = false; });
  EXPECT_FALSE(literal.plan(belief, still_history()).has_view());
}

TEST(FrontierViews, LiteralClustersAreOneAndItsCentroidMayBeUnreachable) {
  // cut, some cluster has a view; uncut, the centroid is in the middle of a closed box and every
  // view around it is inside or beyond the wall
  const SmallPlanner cut = of_single_views();
  const SmallPlanner uncut = of_single_views([](PlannerConfig& c) {
    c.fvs.frontier.max_extent_m = 0.0;
    c.fvs.agvs_when_stuck = false;
  });
  EXPECT_TRUE(cut.plan(shell_of_frontiers(cut), still_history()).has_view());
  EXPECT_FALSE(uncut.plan(shell_of_frontiers(uncut), still_history()).has_view());
}

/// Far from the wall, looking away from it: no view nearby sees any surface.
const ViewPose kTurnedAway{Vec3(-7.5, 0.1, 4.1), kPi};

Plan plan_turned_away(const SmallPlanner& planner, const Belief& belief) {
  return planner.plan(belief, {}, 2, kTurnedAway);
}

SmallPlanner model_of_grid_that_fails(const std::function<void(FvsConfig&)>& change) {
  return of_single_views([&](PlannerConfig& c) {
    c.agvs.scales = false;
    change(c.fvs);
  });
}

TEST(FrontierViews, AreTriedWhereTheGridFindsNothing) {
  const auto plan_with = [](bool are_tried) {
    const SmallPlanner planner =
        model_of_grid_that_fails([&](FvsConfig& fvs) { fvs.when_grid_finds_nothing = are_tried; });
    return plan_turned_away(planner, thin_wall_ahead(planner));
  };
  EXPECT_FALSE(plan_with(false).has_view());
  const Plan plan = plan_with(true);
  ASSERT_TRUE(plan.has_view());
  EXPECT_EQ(plan.next().sampler, Sampler::fvs);
  EXPECT_TRUE(plan.next().via_world_m.empty());
  // the record has the grid's candidates, too
  EXPECT_EQ(plan.candidates.front().rejected, Rejection::sees_no_surface);
}

TEST(FrontierViews, AreReachedOnAWayAroundBeforeTheMissionEnds) {
  const SmallPlanner planner = model_of_grid_that_fails([](FvsConfig&) {});
  Belief belief = thin_wall_ahead(planner);
  // a screen with a gap far to the side, through which no straight way leads
  fill(belief.grid, Box3(Vec3(-4.15, -8, 0), Vec3(-4.05, 4, 8)));
  const Plan plan = plan_turned_away(planner, belief);
  ASSERT_TRUE(plan.has_view());
  EXPECT_EQ(plan.next().sampler, Sampler::fvs);
  EXPECT_GT(plan.next().view.p_world_m.x(), -4.0);
  EXPECT_FALSE(plan.next().via_world_m.empty());
  // straight ways were tried first, and each was blocked
  EXPECT_TRUE(std::ranges::any_of(plan.candidates, [](const Candidate& c) {
    return c.sampler == Sampler::fvs && c.rejected == Rejection::path_blocked;
  }));
  for (std::size_t i = 0; i < plan.chosen.front(); ++i) {
    const Candidate& c = plan.candidates[i];
    EXPECT_TRUE(c.rejected || !c.via_world_m.empty());
  }
}

TEST(LocalMinimum, IsWhereTheVoxelsInViewHaveHardlyChanged) {
  // a quarter of a frustum of 60 by 45 degrees from 0.5 to 8 m in voxels of 0.2 m
  const std::vector<CameraConfig> cameras(2, {.range_min_m = 0.5});
  const PlannerModel model = make_model({}, kWorkspace, cameras, {});
  const double voxels = voxels_in_view(VoxelsInView::quarter_frustum, model);
  EXPECT_NEAR(voxels, 5100.0, 5.0);  // the authors' number
  EXPECT_NEAR(voxels_in_view(VoxelsInView::frusta, model), 8.0 * voxels, 0.001 * 8.0 * voxels);
  // the last change does not count, nor the one before the three that do
  History history;
  history.entropies_nat = {1000.0, 900.0, 890.0, 880.0, 870.0, 500.0};
  EXPECT_TRUE(is_entropy_still(0.002, 3, 1, history, 5100.0));
  EXPECT_FALSE(is_entropy_still(0.002, 3, 0, history, 5100.0));
  EXPECT_FALSE(is_entropy_still(0.002, 4, 1, history, 5100.0));
  EXPECT_FALSE(is_entropy_still(0.0019, 3, 1, history, 5100.0));
  history.entropies_nat.erase(history.entropies_nat.begin(), history.entropies_nat.begin() + 2);
  EXPECT_FALSE(is_entropy_still(0.002, 3, 1, history, 5100.0)) << "two changes only";
}

}  // namespace
}  // namespace gnbv
