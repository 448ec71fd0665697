// Laws of the tour's planner as a whole, before a wall that was scanned thinly.
#include "planner/tour/tour_planner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>

#include "planner/core/belief.hpp"
#include "planner/tour/gains.hpp"
#include "tests/planner/wall_world.hpp"

namespace gnbv {
namespace {

struct TourWorld {
  explicit TourWorld(double range_max_m = 8.0, const Box3& workspace_m = kWorkspace) {
    cameras = {{.range_max_m = range_max_m}};
    planner.config.utility.name = "tour";
    workspace = workspace_m;
  }
  PlannerModel model(std::uint64_t seed) const {
    return make_model(planner.config, workspace, cameras, {}, seed);
  }
  SmallPlanner planner;
  std::vector<CameraConfig> cameras;
  Box3 workspace;
};

/// Where the first plan of that seed flies.
std::vector<ViewPose> first_tour(std::uint64_t seed) {
  const TourWorld world;
  const PlannerModel model = world.model(seed);
  Belief belief = wall_ahead(world.planner, everywhere);
  sample_thinly(belief);
  Scratch scratch(model, 2);
  TourPlanner planner({.price = 0.01, .iterations = 20}, model,
                      true);  // long, and not yet the best
  const Plan plan = planner.next(belief, {}, kCurrent, scratch);
  return plan.tour->plan ? plan.tour->plan->views : std::vector<ViewPose>{};
}

bool are_same(const std::vector<ViewPose>& a, const std::vector<ViewPose>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), is_same_view);
}

TEST(TourPlanner, SearchesByTheMissionsSeed) {
  const std::vector<ViewPose> tour = first_tour(1);
  ASSERT_GE(tour.size(), 4U);
  EXPECT_TRUE(are_same(first_tour(1), tour));
  const std::array<std::uint64_t, 4> others = {2, 3, 4, 5};
  EXPECT_TRUE(std::any_of(others.begin(), others.end(),
                          [&](std::uint64_t seed) { return !are_same(first_tour(seed), tour); }));
}

/// Wherever the plan is, it asks often.
TEST(TourPlanner, StopsWithinASecondWhereverItIs) {
  using Clock = std::chrono::steady_clock;
  const TourWorld world;
  const PlannerModel model = world.model(1);
  Belief belief = wall_ahead(world.planner, everywhere);
  sample_thinly(belief);
  std::atomic<int> polls = 0;
  std::atomic<Clock::time_point> asked = Clock::time_point::max();
  const auto stop_at = [&](int poll) {
    Scratch scratch(model, 2);
    polls = 0;
    scratch.should_stop = [&polls, &asked, poll] {
      const int now = ++polls;
      if (now == poll) asked = Clock::now();
      return now >= poll;
    };
    TourPlanner planner({}, model, true);
    planner.next(belief, {}, kCurrent, scratch);
  };
  stop_at(1 << 30);
  const int all = polls;
  EXPECT_GT(all, 300) << "at each node, and in each round of the search";
  for (const int poll : {1, all / 3, 2 * all / 3, all}) {
    EXPECT_THROW(stop_at(poll), StopRequested) << poll << " of " << all;
    EXPECT_LT(Clock::now() - asked.load(), std::chrono::seconds(1)) << poll << " of " << all;
  }
}

/// Cameras that see a metre far in a box of 100 m would have 700,000 nodes.
TEST(TourState, ALatticeOfItsOwnStepHasNoMoreNodesThanCanBePlannedOver) {
  for (const double range_m : {0.5, 1.0, 8.0}) {
    const TourWorld world(range_m);
    const Box3 box_m(Vec3(0, 0, 0.7), Vec3(100, 100, 15));
    const double step_m = automatic_step_m(world.model(0).cameras, box_m);
    const Roadmap roadmap({box_m, 0.2}, box_m, step_m);
    EXPECT_LE(roadmap.size(), kMostAutomaticNodes);
    EXPECT_GE(step_m, 0.25 * range_m);
  }
  const TourWorld world;
  EXPECT_EQ(automatic_step_m(world.model(0).cameras, Box3(Vec3(0, 0, 0), Vec3(40, 40, 10))), 2.0);
}

}  // namespace
}  // namespace gnbv
