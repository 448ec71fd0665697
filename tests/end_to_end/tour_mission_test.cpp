// Missions of the tour: one result however they are flown, and an end of their own.
#include <gtest/gtest.h>

#include <algorithm>

#include "planner/motion/free_space.hpp"
#include "sim/core/error.hpp"
#include "tests/support/flown.hpp"
#include "tests/support/watch.hpp"
#include "tools/run/run_record.hpp"
#include "tools/run/tour_files.hpp"

namespace gnbv {
namespace {

Scenario tour(std::vector<std::string> overrides = {}) {
  overrides.emplace_back("planner.utility.name=tour");
  return smoke(overrides);
}

TEST(TourMission, ARecordOfOtherViewsIsNotResumed) {
  const Scenario scenario = tour({"planner.termination.max_iterations=4"});
  MissionInputs resumed;
  for (const ViewRecord& view : Flown(scenario).result.views) {
    resumed.replay.push_back(view.decision);
  }
  resumed.replay[2].view.yaw_rad += 0.5;
  EXPECT_THROW(Flown(scenario, resumed), BadInput);
}

TEST(TourMission, EndsByItselfWithoutACollisionAndSaysWhatItsViewsBrought) {
  const Flown flown(tour({"planner.termination.max_iterations=200"}));
  const MissionResult& result = flown.result;
  EXPECT_EQ(result.termination, Termination::tour_complete);
  EXPECT_LT(result.views.size(), 100U);
  double promised = 0.0;
  double found = 0.0;
  for (const ViewOutcome& outcome : result.gain_outcomes) {
    EXPECT_GE(outcome.gain.missing, outcome.gain.found);
    promised += outcome.gain.predicted;
    found += outcome.gain.found;
  }
  EXPECT_GT(found, 0.0);
  EXPECT_GT(promised, 0.3 * found);
}

TEST(TourMission, FliesWhatItPlansAndSaysSoOutsideTheResult) {
  Flown flown(tour({"planner.termination.max_iterations=12", "planner.tour.replan_below=0"}));
  MissionResult& result = flown.result;
  const RunRecord record{.folder = "", .scenario = flown.scenario, .views = result.views};
  ASSERT_FALSE(result.tour_plans.empty());
  EXPECT_LT(result.tour_plans.size() + 3, result.views.size());  // some views go on with a plan
  for (std::size_t i = 0; i + 1 < result.views.size(); ++i) {
    const StandingPlan standing = standing_plan(result.tour_plans, record, i).value();
    const ViewPose& next = result.views[i + 1].decision.view;
    EXPECT_TRUE(std::any_of(standing.views().begin(), standing.views().end(),
                            [&](const ViewPose& view) { return is_same_view(view, next); }))
        << i;
    EXPECT_FALSE(standing.made->plan.cubes.empty());
  }
  const std::string hash = result_sha256(result);
  result.tour_plans.clear();
  EXPECT_EQ(result_sha256(result), hash);
}

TEST(TourMission, FliesEachLegThroughSpaceKnownToBeFree) {
  const Scenario scenario = tour({"planner.termination.max_iterations=12"});
  Watch watch;
  std::size_t legs = 0;
  const Belief* believed = nullptr;
  Vec3 at_m = Vec3::Zero();
  watch.view = [&](const ViewRecord& view, const Belief& belief) {
    at_m = view.decision.view.p_world_m;
    believed = &belief;
  };
  watch.plan = [&](std::size_t, const Plan& plan) {
    if (!plan.has_view() || believed == nullptr) return;
    std::vector<Vec3> points_m = plan.next().via_world_m;
    points_m.push_back(plan.next().view.p_world_m);
    Vec3 from_m = at_m;
    for (const Vec3& to_m : points_m) {
      EXPECT_TRUE(is_line_free(believed->grid, from_m, to_m));
      EXPECT_TRUE(is_path_clear(believed->grid, from_m, to_m,
                                scenario.planner.validity.collision_radius_m));
      from_m = to_m;
      ++legs;
    }
  };
  const Flown flown(scenario, {.observers = {&watch}});
  EXPECT_GE(legs, 6U);
}

TEST(TourMission, FliesAroundABoxWhereNobodyMayFly) {
  const Scenario scenario = tour({"planner.termination.max_iterations=60",
                                  "no_fly=[{min: [1.7, -4, 0], max: [1.9, 4, 2.6]}]"});
  const NoFly no_fly = no_fly_of(scenario);
  Watch watch;
  Vec3 at_m = Vec3::Zero();
  std::size_t ways_around = 0;
  watch.view = [&](const ViewRecord& view, const Belief&) { at_m = view.decision.view.p_world_m; };
  watch.plan = [&](std::size_t, const Plan& plan) {
    if (!plan.has_view() || no_fly.allows_leg(at_m, plan.next().view.p_world_m)) return;
    EXPECT_FALSE(plan.next().via_world_m.empty());
    EXPECT_GT(plan.candidates.at(plan.chosen.at(0)).path_m,
              (plan.next().view.p_world_m - at_m).norm());
    ++ways_around;
  };
  const Flown flown(scenario, {.observers = {&watch}});
  EXPECT_GT(ways_around, 0U);
  EXPECT_EQ(flown.result.termination, Termination::tour_complete);
}

TEST(TourMission, IsNotCompleteWhereAllThatPaysIsRefused) {
  const Flown flown(
      tour({"planner.validity.recent_distance_m=50", "planner.validity.recent_yaw_deg=180"}));
  EXPECT_EQ(flown.result.termination, Termination::no_valid_view);
  EXPECT_GT(flown.result.last_rejections.at(Rejection::recently_visited), 0);
}

/// The parts are switches: each alone changes what is flown.
TEST(TourMission, EachSwitchChangesTheTour) {
  const std::vector<std::string> few = {"planner.termination.max_iterations=8"};
  const std::string hash = result_sha256(Flown(tour(few)).result);
  for (const char* change :
       {"planner.tour.price=0.2", "planner.tour.metres_per_view=3", "planner.tour.yaw_step_deg=90",
        "planner.tour.iterations=0", "planner.tour.double_cover=false"}) {
    std::vector<std::string> overrides = few;
    overrides.emplace_back(change);
    EXPECT_NE(result_sha256(Flown(tour(overrides)).result), hash) << change;
  }
}

TEST(TourMission, WithoutAProfileItLooksForTheStructureFirst) {
  // begins with its back to the structure
  std::vector<std::string> unknown = {"planner.profiling.method=none", "start.yaw_deg=-90",
                                      "planner.termination.max_iterations=200"};
  const auto points = [](const Flown& flown) {
    return static_cast<double>(flown.result.belief.cloud.points_world_m().size());
  };
  const Flown explored(tour(unknown));
  EXPECT_EQ(explored.result.termination, Termination::tour_complete);
  EXPECT_GT(points(explored),
            0.9 * points(Flown(tour({"planner.termination.max_iterations=200"}))));
  unknown.emplace_back("planner.tour.explore=false");
  EXPECT_LT(points(Flown(tour(unknown))), 0.1 * points(explored));
}

}  // namespace
}  // namespace gnbv
