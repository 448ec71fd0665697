// Missions from take-off on: no profile, views passed, frames and sweeps between them.
#include <gtest/gtest.h>

#include "scenarios/load.hpp"
#include "tests/support/flown.hpp"
#include "tests/support/watch.hpp"
#include "tools/run/mission_result.hpp"

namespace gnbv {
namespace {

Scenario takeoff(std::vector<std::string> overrides = {}) {
  overrides.insert(overrides.begin(), {"planner.utility.name=tour", "planner.preset=takeoff",
                                       "planner.termination.max_iterations=100"});
  return smoke(overrides);
}

TEST(Takeoff, EndsByItselfWithAsMuchAsAfterAProfileInLessTime) {
  const Flown flown(takeoff());
  EXPECT_EQ(flown.result.termination, Termination::tour_complete);
  EXPECT_EQ(flown.result.distance.profile_m, 0.0);
  EXPECT_EQ(flown.result.legs_timed_out, 0);
  const Flown profiled(smoke({"planner.utility.name=tour", "guidance.profile_speed_m_s=1",
                              "planner.termination.max_iterations=100"}));
  const auto points = [](const Flown& one) {
    return static_cast<double>(one.result.belief.cloud.points_world_m().size());
  };
  EXPECT_GT(points(flown), 0.95 * points(profiled));
  EXPECT_LT(flown.result.flight_time_s, 0.6 * profiled.result.flight_time_s);
}

TEST(Takeoff, TheResultDependsNeitherOnThreadsNorOnAStop) {
  const Scenario scenario = takeoff({"planner.termination.max_iterations=12"});
  const Flown one(scenario, {}, 1);
  const std::string hash = result_sha256(one.result);
  EXPECT_EQ(result_sha256(Flown(scenario, {}, 2).result), hash);
  MissionInputs resumed;
  for (std::size_t i = 0; i < 5; ++i) resumed.replay.push_back(one.result.views[i].decision);
  EXPECT_EQ(result_sha256(Flown(scenario, resumed).result), hash);
}

TEST(Takeoff, SweepsBetweenViewsAreSurfaceToLookAtAndCoverNothing) {
  // without a profile and without a camera's return, nothing else can fill map or cloud
  Watch watch;
  std::size_t ranged = 0;
  std::size_t covered = 0;
  watch.view = [&](const ViewRecord&, const Belief& belief) {
    ranged = belief.ranged.points_world_m().size();
    covered = belief.cloud.points_world_m().size();
  };
  const std::vector<std::string> blind = {"cameras.0.range_max_m=0.31", "cameras.0.range_min_m=0.3",
                                          "planner.termination.max_iterations=4",
                                          "planner.tour.explore=true"};
  const Flown with(takeoff(blind), {.observers = {&watch}});
  EXPECT_GT(ranged, 100U);
  EXPECT_EQ(covered, 0U);
  std::vector<std::string> without = blind;
  without.emplace_back("planner.profiling.flight_rate_hz=0");
  const Flown none(takeoff(without), {.observers = {&watch}});
  EXPECT_EQ(ranged, 0U);
}

TEST(Takeoff, ThePresetSetsWhatNobodyGaveAndLeavesNothingBehind) {
  const Scenario preset = smoke({"planner.preset=takeoff"});
  EXPECT_EQ(preset.guidance.trajectory, Trajectory::smooth);
  EXPECT_EQ(preset.cameras[0].rate_hz, 5.0);
  EXPECT_EQ(preset.planner.profiling.method, ProfilingMethod::none);
  EXPECT_EQ(preset.planner.tour.cost, TourCost::seconds);
  const Scenario given = smoke({"guidance.trajectory=legs", "cameras.0.rate_hz=2",
                                "planner.preset=takeoff", "planner.profiling.method=circular"});
  EXPECT_EQ(given.guidance.trajectory, Trajectory::legs);
  EXPECT_EQ(given.cameras[0].rate_hz, 2.0);
  EXPECT_EQ(given.planner.profiling.method, ProfilingMethod::circular);
  EXPECT_EQ(to_yaml(smoke({"planner.preset=takeoff", "planner.preset=paper"})), to_yaml(smoke()));
}

}  // namespace
}  // namespace gnbv
