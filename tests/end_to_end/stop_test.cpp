// What ends a mission: the limits hold, and the truth ends only what a benchmark told it to.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <atomic>
#include <nlohmann/json.hpp>

#include "bench/score/surface_reference.hpp"
#include "planner/core/belief.hpp"
#include "sim/core/file.hpp"
#include "tests/bench/shapes.hpp"
#include "tests/support/flown.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/mission/coverage_goal.hpp"
#include "tools/mission/execute.hpp"

namespace gnbv {
namespace {

const MissionResult& whole() {
  static const Flown kFlight(smoke());
  return kFlight.result;
}

MissionResult fly(const std::string& set, const MissionInputs& inputs = {}) {
  return Flown(smoke({set}), inputs).result;
}

TEST(Stop, IsHonouredWithinALeg) {
  int asked = 0;
  const MissionResult flown = fly("guidance.profile_speed_m_s=0.2", {.should_stop = [&] {
                                    return ++asked > 25;  // 0.1 s of flight
                                  }});
  EXPECT_EQ(flown.termination, Termination::interrupted);
  EXPECT_LT(flown.flight_time_s, 1.0);
}

TEST(Stop, IsHonouredWhileAnOraclePlans) {
  const TempFolder temp;
  std::atomic<int> asked = 0;
  const ExecutedMission mission = execute_mission(
      smoke({"planner.utility.name=oracle_metres"}),
      {.out = temp.path() / "run", .quiet = true, .should_stop = [&] { return ++asked > 100; }});
  EXPECT_EQ(mission.result.termination, Termination::interrupted);
  EXPECT_LT(mission.result.flight_time_s, 0.01);  // a tick, before the mission asks
  EXPECT_LT(asked, 1000);                         // each thread is told, and the mission
}

TEST(MaxDistance, TheLastLegThatFitsIsTheLast) {
  ASSERT_GE(whole().views.size(), 6U);
  const double fits_m = whole().views[4].straight_m;  // that of the whole mission's fifth view
  const std::string set = fmt::format("planner.termination.max_distance_m={}", fits_m);
  const MissionResult flown = fly(set);
  EXPECT_EQ(flown.termination, Termination::max_distance);
  EXPECT_EQ(flown.views.size(), 5U);
  EXPECT_EQ(flown.distance.straight_m, fits_m);
  const MissionResult shorter =
      fly(fmt::format("planner.termination.max_distance_m={}", fits_m - 1e-6));
  EXPECT_EQ(shorter.views.size(), 4U);
}

TEST(MaxFlightTime, EndsInFlightAtThatTick) {
  const double end_s = 0.5 * (whole().views[4].time_s + whole().views[5].time_s);
  const std::string set = fmt::format("planner.termination.max_flight_time_s={}", end_s);
  const MissionResult flown = fly(set);
  EXPECT_EQ(flown.termination, Termination::max_flight_time);
  EXPECT_EQ(flown.views.size(), 5U);
  EXPECT_NEAR(flown.flight_time_s, end_s, kTick_s);
  EXPECT_EQ(fly("planner.termination.max_flight_time_s=5").views.size(), 0U);  // in the profile
}

TEST(StopAtCoverage, EndsAtTheFirstViewAfterWhichTheScoreHasIt) {
  const std::string set = "benchmark.stop_at_coverage=0.7";
  const TempFolder temp;
  const ExecutedMission mission =
      execute_mission(smoke({set}), {.out = temp.path() / "run", .quiet = true});
  EXPECT_EQ(mission.result.termination, Termination::coverage_reached);
  const auto& curve = mission.score.curve.coverage;
  ASSERT_GE(curve.size(), 3U);
  EXPECT_GE(curve.back()[0], 0.7);
  EXPECT_LT(curve[curve.size() - 2][0], 0.7);
  const auto summary = nlohmann::json::parse(read_file(mission.folder / "summary.json"));
  EXPECT_EQ(summary["termination"], "coverage_reached");
  EXPECT_EQ(summary["ended_by_truth"], true);
}

TEST(StopAtCoverage, CountsNoPointOfAnObstacle) {
  // a fence 0.02 m before the wall, in its voxels, and terrain as near: nothing of it is covered
  World world;
  test::add_sheet(world.structure, Vec3(2.04, -1, 1), Vec3(0, 2, 0), Vec3(0, 0, 2));
  const SurfaceReference reference = make_surface_reference(world, RayScene(world), {}, 2);
  const PlannerModel model({}, {}, Box3(Vec3(-4, -4, 0), Vec3(4, 4, 4)), {}, {});
  const auto is_covered_by = [&](double x) {
    Belief belief(model);
    std::vector<Vec3f> points;
    for (double z = 1.01; z < 3.0; z += 0.025) {
      for (double y = -0.99; y < 1.0; y += 0.025) points.push_back(Vec3(x, y, z).cast<float>());
    }
    belief.cloud.add(points, model.belief.cloud.leaf_m);
    const RayScene scene(world);
    return coverage_goal({.stop_at_coverage = 0.9}, reference, scene)(belief);
  };
  EXPECT_TRUE(is_covered_by(2.02));
  test::add_sheet(world.obstacles, Vec3(2.015, -1, 1), Vec3(0, 2, 0), Vec3(0, 0, 2));
  EXPECT_FALSE(is_covered_by(2.02));
  EXPECT_TRUE(is_covered_by(2.04));
  std::swap(world.obstacles, world.terrain);
  EXPECT_FALSE(is_covered_by(2.02));
}

TEST(StopAtCoverage, IsOffByDefaultAndSoIsTheTruth) {
  EXPECT_FALSE(coverage_goal({}, {}, RayScene(World{}))(whole().belief));
  const TempFolder temp;
  const ExecutedMission mission = execute_mission(smoke({"planner.termination.max_iterations=1"}),
                                                  {.out = temp.path() / "run", .quiet = true});
  const auto summary = nlohmann::json::parse(read_file(mission.folder / "summary.json"));
  EXPECT_EQ(summary["termination"], "max_iterations");
  EXPECT_EQ(summary["ended_by_truth"], false);
}

}  // namespace
}  // namespace gnbv
