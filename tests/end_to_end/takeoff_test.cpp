// Missions from take-off on: no profile, views passed, frames and sweeps between them.
#include <gtest/gtest.h>

#include "scenarios/load.hpp"
#include "tests/support/flown.hpp"
#include "tests/support/known_inputs.hpp"
#include "tests/support/watch.hpp"
#include "tools/mission/reference.hpp"
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

TEST(Takeoff, BrakesWhereTheMissionEnds) {
  for (const std::uint64_t seed : {1, 3, 5}) {
    const std::string s = fmt::format("seed={}", seed);
    const Flown empty(takeoff({s, "vehicle.power.battery_wh=0.7"}));
    EXPECT_EQ(empty.result.termination, Termination::battery);
    EXPECT_LT(empty.result.energy_wh, 0.7);
    const Flown late(takeoff({s, "planner.termination.max_flight_time_s=15"}));
    EXPECT_EQ(late.result.termination, Termination::max_flight_time);
    EXPECT_LT(late.result.flight_time_s, 15.0 + 4.0);  // from 2 m/s at 1 m/s2
  }
}

/// Seeds from whose start no node of the lattice is in sight.
TEST(Takeoff, GoesOnWhereTheStartHasSeenLittle) {
  for (const std::uint64_t seed : {5, 10, 32}) {
    const Flown flown(takeoff({fmt::format("seed={}", seed)}));
    EXPECT_EQ(flown.result.termination, Termination::tour_complete);
    EXPECT_GT(flown.result.views.size(), 5U) << seed;
  }
}

/// The gimbal takes up to 1.5 s; a view that is past by then is come back to.
TEST(Takeoff, WaitsForTheGimbalNearTheView) {
  const Flown flown(takeoff({"seed=2", "cameras.0.pitch_deg={min: -30, max: 60, step: 30}"}));
  const std::vector<ViewRecord>& views = flown.result.views;
  for (std::size_t i = 1; i < views.size(); ++i) {
    const double straight_m = views[i].straight_m - views[i - 1].straight_m;
    EXPECT_LT(views[i].flown_m - views[i - 1].flown_m, straight_m + 4.0) << i;
  }
}

/// Its map knows nothing of the way; the oracle does.
TEST(Takeoff, AnOracleFliesThroughSpaceThatNobodyHasSeen) {
  const Scenario scenario =
      takeoff({"planner.utility.name=oracle_seconds", "planner.oracle.coverage=0.9"});
  const World world = world_of(scenario);
  const RayScene scene(world);
  const SurfaceReference reference = reference_of(scenario, world, scene, 2);
  const MissionInputs inputs = known_inputs(scenario, world, scene, reference);
  const MissionResult result = run_mission(scenario, world, scene, inputs, 2);
  EXPECT_EQ(result.termination, Termination::route_flown);
  EXPECT_EQ(result.legs_timed_out, 0);
  EXPECT_GT(result.distance.flown_m, 5.0);
  for (const TrajectorySample& sample : result.trajectory) {
    EXPECT_GT(scene.clearance_m(sample.T_world_body.translation(), 9.0),
              scenario.planner.validity.collision_radius_m - 0.2);
  }
}

TEST(Takeoff, SmoothWaysMayCrossWhatIsUnknownWhereThatIsAllowed) {
  const Flown flown(smoke({"seed=2", "guidance.trajectory=smooth", "planner.profiling.method=none",
                           "planner.validity.allow_unknown=true"}));
  EXPECT_EQ(flown.result.legs_timed_out, 0);
  EXPECT_GT(flown.result.distance.flown_m, 2.0);
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

TEST(Takeoff, FromTheGroundItClimbsToWhereTheOthersBegin) {
  for (const std::string kind : {"quadrotor", "ideal"}) {
    std::vector<std::string> keys = {"planner.termination.max_iterations=3",
                                     "vehicle.kind=" + kind};
    const MissionResult air = Flown(takeoff(keys)).result;
    keys.emplace_back("start.on_ground=true");
    const MissionResult ground = Flown(takeoff(keys), {}, 1).result;
    const double up_m = air.start.p_world_m.z();
    EXPECT_EQ(ground.start.p_world_m, air.start.p_world_m);
    EXPECT_LT(ground.trajectory.front().T_world_body.translation().z(), 0.3) << kind;
    EXPECT_NEAR(ground.distance.profile_flown_m, up_m, 0.4) << kind;
    // 2 m/s at most, and what the rotors take to spool up
    EXPECT_GT(ground.profile_end_s - air.profile_end_s, up_m / 2.0) << kind;
    EXPECT_LT(ground.profile_end_s - air.profile_end_s, up_m / 2.0 + 10.0) << kind;
    EXPECT_GT(ground.views[0].energy_wh, air.views[0].energy_wh) << kind;
    EXPECT_EQ(ground.termination, air.termination) << kind;
    EXPECT_EQ(result_sha256(Flown(takeoff(keys), {}, 2).result), result_sha256(ground)) << kind;
  }
}

TEST(Takeoff, SharpFramesAreTakenSlowly) {
  // 2 m/s are flown where nothing is nearer than 4 m
  const std::vector<std::string> few = {"planner.termination.max_iterations=12"};
  std::vector<std::string> keys = few;
  const MissionResult fast = Flown(takeoff(keys)).result;
  keys.emplace_back("guidance.image_motion_max_deg_s=20");
  const Flown slow(takeoff(keys));
  const double most_rad_s = deg_to_rad(20.0);
  const auto worst = [&](const MissionResult& result) {
    double most = 0.0;
    for (std::size_t i = 1; i < result.trajectory.size(); ++i) {
      const auto& [before_s, before] = result.trajectory[i - 1];
      const auto& [now_s, now] = result.trajectory[i];
      const double speed_m_s =
          (now.translation() - before.translation()).norm() / (now_s - before_s);
      const double away_m = slow.scene.clearance_m(now.translation(), 10.0);
      most = std::max(most, speed_m_s / away_m);
      most = std::max(most,
                      std::abs(wrap_angle_rad(yaw_of(now) - yaw_of(before))) / (now_s - before_s));
    }
    return most;
  };
  // what nobody has seen yet may be nearer than what is known
  EXPECT_LT(worst(slow.result), 1.5 * most_rad_s);
  EXPECT_GT(worst(fast), 2.0 * most_rad_s);
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
