// What ends a mission: the limits hold, and the truth ends only what a benchmark told it to.
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <atomic>
#include <nlohmann/json.hpp>

#include "bench/score/surface_reference.hpp"
#include "planner/core/belief.hpp"
#include "scenarios/load.hpp"
#include "sim/core/file.hpp"
#include "tests/bench/shapes.hpp"
#include "tests/support/flown.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/mission/execute.hpp"
#include "tools/mission/resolve.hpp"

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
  const MissionResult flown = fly(fmt::format("planner.termination.max_distance_m={}", fits_m));
  EXPECT_EQ(flown.termination, Termination::max_distance);
  EXPECT_EQ(flown.views.size(), 5U);
  EXPECT_EQ(flown.distance.straight_m, fits_m);
  const MissionResult shorter =
      fly(fmt::format("planner.termination.max_distance_m={}", fits_m - 1e-6));
  EXPECT_EQ(shorter.views.size(), 4U);
}

TEST(MaxFlightTime, EndsInFlightAtThatTick) {
  const double end_s = 0.5 * (whole().views[4].time_s + whole().views[5].time_s);
  const MissionResult flown = fly(fmt::format("planner.termination.max_flight_time_s={}", end_s));
  EXPECT_EQ(flown.termination, Termination::max_flight_time);
  EXPECT_EQ(flown.views.size(), 5U);
  EXPECT_NEAR(flown.flight_time_s, end_s, kTick_s);
  EXPECT_EQ(fly("planner.termination.max_flight_time_s=5").views.size(), 0U);  // in the profile
}

TEST(MaxIterations, InsideABurstEndThereOrAfterItsLastView) {
  const auto flown = [](const std::string& where) {
    return Flown(smoke({"planner.fvs.mode=burst", "planner.fvs.entropy_threshold_nat=1",
                        "planner.termination.max_iterations=6",
                        "planner.termination.within_plans=" + where}))
        .result;
  };
  const MissionResult there = flown("true");
  const MissionResult after = flown("false");
  ASSERT_EQ(there.views.size(), 6U);
  EXPECT_EQ(there.views.back().decision.plan_view, 2);
  ASSERT_GT(after.views.size(), 6U);
  for (std::size_t i = 0; i < there.views.size(); ++i) {
    EXPECT_TRUE(is_same_view(after.views[i].decision.view, there.views[i].decision.view));
  }
  for (std::size_t i = 6; i < after.views.size(); ++i) {
    EXPECT_EQ(after.views[i].decision.plan_view, static_cast<int>(i) - 3);
  }
  EXPECT_EQ(there.termination, Termination::max_iterations);
  EXPECT_EQ(after.termination, Termination::max_iterations);
}

/// The mission with that setting, and its summary.
std::pair<ExecutedMission, nlohmann::json> executed(const std::string& set) {
  const TempFolder temp;
  ExecutedMission mission =
      execute_mission(smoke({set}), {.out = temp.path() / "run", .quiet = true});
  return {std::move(mission), nlohmann::json::parse(read_file(temp.path() / "run/summary.json"))};
}

TEST(StopAtCoverage, EndsAtTheFirstViewAfterWhichTheScoreHasIt) {
  const auto [mission, summary] = executed("benchmark.stop_at_coverage=0.7");
  EXPECT_EQ(mission.result.termination, Termination::coverage_reached);
  const auto& curve = mission.score.curve.coverage;
  ASSERT_GE(curve.size(), 3U);
  EXPECT_GE(curve.back()[0], 0.7);
  EXPECT_LT(curve[curve.size() - 2][0], 0.7);
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
  const nlohmann::json summary = executed("planner.termination.max_iterations=1").second;
  EXPECT_EQ(summary["termination"], "max_iterations");
  EXPECT_EQ(summary["ended_by_truth"], false);
}

// Keys that are said to have no effect have none: the same mission is flown with other values.

/// A key with another value than its default, where it is idle.
struct Case {
  std::vector<std::string> where;
  std::vector<std::string> sets;
};

const std::vector<Case>& cases() {
  const std::string utility = "planner.utility.";
  static const std::vector<Case> kCases = {
      {{},
       {"structure.file={scale: 2, unit_m: 0.5, up_axis: x, offset_m: [9, 9, 9]}",
        "planner.profiling={circle_stations: 3, climb_step_m: 0.2, file: x.map}",
        "planner.agvs.entropy_window=1", "planner.termination.new_voxels_window=1",
        "planner.routes={standoff_m: 1, overlap: 0.9}", "planner.tour={iterations: 1, price: 0.1}",
        utility + "bircher_lambda_per_m=3", utility + "ig_counting=unique",
        utility + "hit_voxel=excluded", utility + "leaving_rays=dropped",
        utility + "volume_weights={free: 7}", utility + "shadow={shadow_depth_m: 0.3}",
        utility + "legacy_visibility=true", "vehicle.power={battery_wh: 99, reserve_share: 0.3}",
        "cameras.0.noise={baseline_m: 0.5, disparity_noise_px: 5}"}},
      {{"planner.utility.name=isler"},
       {utility + "alpha=0", utility + "beta=9", utility + "gamma=9", utility + "lambda_per_m=9",
        utility + "density_term=literal", utility + "normalise_weights=false",
        utility + "distance=straight", utility + "legacy_visibility=true",
        utility + "prediction_hides_hits=true", "planner.symmetry={enabled: false}"}},
      {{"planner.utility.name=bircher"}, {utility + "alpha=0", utility + "lambda_per_m=9"}},
      {{"planner.utility.name=area_factor"}, {utility + "gamma=9", utility + "distance=straight"}},
      {{"planner.utility.name=lawnmower"},
       {"planner.agvs={step_m: 3, scales: false}", "planner.fvs={enabled: false}",
        utility + "alpha=0", utility + "legacy_visibility=true"}},
      {{"planner.utility.name=uniform_hemisphere"}, {"planner.routes.overlap=0.9"}},
      {{"planner.utility.name=tour"},
       {"planner.agvs={step_m: 3, scales: false}", "planner.fvs={enabled: false}",
        utility + "alpha=0", utility + "legacy_visibility=true",
        "planner.termination={entropy_change_percent: 50, entropy_window: 1, repeated_moves: 1}"}},
      {{"planner.symmetry.enabled=false"}, {"planner.symmetry={min_support: 0, min_confirmed: 0}"}},
      {{"planner.agvs.scales=false"},
       {"planner.agvs={scale_factor: 3, scale_max: 1, utility_threshold: 99, utility_window: 1, "
        "repeated_moves: 1, entropy_threshold_nat: 1, entropy_window: 1}"}},
      {{"planner.fvs.enabled=false"},
       {"planner.fvs={tries: 1, looks_max: 2, radius_m: 1, views_per_layer: 9, layer_step_m: 0.1, "
        "order: "
        "largest, pool_clusters: true, needs_visible_cluster: false, agvs_when_stuck: false, "
        "when_grid_finds_nothing: false, entropy_threshold_nat: 1, entropy_window: 1, frontier: "
        "{neighbour_voxels: 9, min_cluster_voxels: 99, max_extent_m: 9}}"}},
      {{"planner.fvs.entropy_threshold_nat=0"}, {"planner.fvs.entropy_window=1"}},
      {{"planner.profiling.method=none"},
       {"planner.profiling.scan_in_transit=false", "guidance.profile_speed_m_s=0.5"}},
      {{"planner.validity.path=unchecked"}, {"planner.validity.path_search.max_expansions=1"}},
      {{"planner.validity.recent_poses=0"},
       {"planner.validity={recent_distance_m: 9, recent_yaw_deg: 90}"}},
      {{"planner.termination.entropy_change_percent=0"}, {"planner.termination.entropy_window=1"}},
      {{"vehicle.kind=ideal"},
       {"vehicle.autopilot={position_p_per_s: [2, 2, 2], tilt_max_deg: 9}"}},
  };
  return kCases;
}

std::vector<std::string> joined(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::vector<std::string> notes_of(const std::vector<std::string>& sets) {
  std::vector<std::string> notes;
  load_with_overrides("smoke", overrides_of(sets), {}, &notes);
  return notes;
}

TEST(UnusedParameters, ChangeNoMissionAndAreNoted) {
  for (const Case& c : cases()) {
    const auto where = joined({"planner.termination.max_iterations=6"}, c.where);
    EXPECT_EQ(result_sha256(Flown(smoke(where)).result),
              result_sha256(Flown(smoke(joined(where, c.sets))).result))
        << c.sets.front();
    const std::string notes = fmt::format("{}", fmt::join(notes_of(joined(c.where, c.sets)), "\n"));
    for (const std::string& set : c.sets) {
      EXPECT_NE(notes.find("(--set " + set + ")"), std::string::npos) << set;
    }
  }
}

TEST(UnusedParameters, AKeyOfWhatIsInUseIsNotAmongThem) {
  const std::vector<std::string> none;
  EXPECT_EQ(notes_of({"planner.utility.alpha=1", "planner.agvs.step_m=0.5",
                      "planner.termination={min_new_voxels_per_m: 1, new_voxels_window: 3}"}),
            none);
  EXPECT_EQ(notes_of({"planner.utility={name: isler, ig_counting: unique}"}), none);
  // one note, though the name came later
  EXPECT_EQ(notes_of({"planner.utility.alpha=1", "planner.utility.name=isler"}),
            std::vector<std::string>{"planner.utility.alpha (--set planner.utility.alpha=1) has no "
                                     "effect: planner.utility.name is isler"});
}

}  // namespace
}  // namespace gnbv
