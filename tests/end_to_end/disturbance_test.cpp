// Missions in wind, with cameras that lose frames, without satellites, and home on one battery.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <set>

#include "sim/core/file.hpp"
#include "sim/flight/guidance.hpp"
#include "sim/flight/rotors.hpp"
#include "tests/support/flown.hpp"
#include "tests/support/temp_folder.hpp"

namespace gnbv {
namespace {

using Overrides = std::vector<std::string>;

TEST(AdverseMission, EachOfTheseMakesItAnother) {
  const Overrides noise = {"cameras.0.noise.model=nguyen", "lidars.0.range_sigma_m=0.02",
                           "start.jitter_m=[0,0,0]", "planner.termination.max_iterations=3"};
  const Overrides satellites = {
      "vehicle.estimate.model=gnss", "vehicle.estimate.outage_drift_m_per_sqrt_s=0.05",
      "planner.profiling.method=none", "planner.validity.allow_unknown=true",
      "planner.termination.max_iterations=5"};
  const std::pair<Overrides, std::string> cases[] = {
      {noise, "seed=2"}, {satellites, "vehicle.estimate.outages=[{start_s: 2, duration_s: 10}]"}};
  for (const auto& [mission, change] : cases) {
    Overrides changed = mission;
    changed.push_back(change);
    EXPECT_NE(result_sha256(Flown(smoke(mission)).result),
              result_sha256(Flown(smoke(changed)).result))
        << change;
  }
}

TEST(WindyMission, LeavesItsPathInGustsAndLittleOtherwise) {
  const Overrides few = {"planner.termination.max_iterations=4"};
  const auto error_of = [&](const Overrides& wind) {
    Overrides all = few;
    all.insert(all.end(), wind.begin(), wind.end());
    const Flown flown(smoke(all));
    EXPECT_EQ(flown.result.termination, Termination::max_iterations);
    return flown.result.path_error;
  };
  const PathError calm = error_of({});
  const PathError steady = error_of({"wind.mean_m_s=[4,0,0]"});
  const PathError gusty = error_of({"wind.mean_m_s=[4,0,0]", "wind.gust_w20_m_s=7.7"});
  EXPECT_LT(calm.max_m, 0.05);                   // 2 cm: what feed-forward leaves of a leg
  EXPECT_LT(steady.max_m, 0.15);                 // 9 cm: trimmed from the start, not for each speed
  EXPECT_GT(gusty.rms_m(), 3.0 * calm.rms_m());  // 29 cm, of 0.6
}

TEST(StormyMission, EndsForAStatedReason) {
  // near the limit of the tilt, with severe gusts: blown away, or against the structure
  const Flown flown(smoke({"wind.mean_m_s=[0,-19,0]", "wind.gust_w20_m_s=23.2"}));
  const std::set<Termination> ends = {Termination::off_course, Termination::collision};
  EXPECT_TRUE(ends.contains(flown.result.termination)) << name_of(flown.result.termination);
  EXPECT_TRUE(flown.result.final_state.v_world_m_s.allFinite());
}

TEST(CameraThatDropsFrames, LeavesTheViewsWithoutThem) {
  const Flown blind(
      smoke({"cameras.0.drop_probability=1", "planner.termination.entropy_change_percent=0",
             "planner.termination.max_iterations=4"}));
  const MissionResult& result = blind.result;
  EXPECT_EQ(result.frames.taken, 0);
  EXPECT_EQ(result.frames.dropped, static_cast<std::int64_t>(result.views.size()));
  EXPECT_EQ(result.belief.cloud.points_world_m().size(), result.profile_points_world_m.size());

  const Flown lossy(smoke({"cameras.0.drop_probability=0.5"}));
  const FrameCounts& frames = lossy.result.frames;
  EXPECT_EQ(frames.taken + frames.dropped, static_cast<std::int64_t>(lossy.result.views.size()));
  EXPECT_GT(frames.taken, 0);
  EXPECT_GT(frames.dropped, 0);
}

void expect_home(const Flown& flown) {
  const MissionResult& result = flown.result;
  ASSERT_TRUE(result.home.has_value());
  EXPECT_TRUE(result.home->reached);
  EXPECT_TRUE(result.home->landed);
  const Vec3 p_m = result.final_state.T_world_body.translation();
  EXPECT_LT((p_m - result.start.p_world_m).head<2>().norm(), 0.1);  // arrived
  EXPECT_LT(p_m.z(), 0.1);                                          // on its hull, 0.11 m high
}

TEST(Battery, BringsTheVehicleHomeBeforeItIsEmpty) {
  const Overrides home = {"vehicle.power.return_home=true"};
  const double whole_wh = Flown(smoke(home)).result.energy_wh;
  for (const double reserve_share : {0.0, 0.2}) {
    for (const double share : {0.35, 0.6, 0.8}) {  // in the profile, and among the views
      const double battery_wh = share * whole_wh / (1.0 - reserve_share);
      const Flown flown(smoke({"vehicle.power.return_home=true",
                               fmt::format("vehicle.power.reserve_share={}", reserve_share),
                               fmt::format("vehicle.power.battery_wh={}", battery_wh)}));
      SCOPED_TRACE(fmt::format("{} Wh, reserve {}", battery_wh, reserve_share));
      EXPECT_EQ(flown.result.termination, Termination::battery);
      expect_home(flown);
      EXPECT_LE(flown.result.energy_wh, (1.0 - reserve_share) * battery_wh);
      // and not long before: what is left beside the reserve is the allowance of a few legs, a
      // fifth of the smallest battery
      EXPECT_GT(flown.result.energy_wh, (0.6 - reserve_share) * battery_wh);
    }
  }
}

TEST(ReturnHome, LeadsAroundANoFlyBox) {
  // flown around the structure, the last view has the box between it and the start, 3 m away
  const Box3 box_m(Vec3(1.4, -4, 0), Vec3(1.6, -1.9, 5));
  const Flown flown(smoke({"no_fly=[{min: [1.4, -4, 0], max: [1.6, -1.9, 5]}]",
                           "vehicle.power.return_home=true", "planner.utility.name=route",
                           "planner.routes.views=[{position_m: [-3.1, 0, 2]}, {position_m: [0, "
                           "3.1, 2]}, {position_m: [3.1, 0, 2]}, {position_m: [3.1, -2.8, 2]}]"}));
  ASSERT_EQ(flown.result.views.size(), 5U);  // with the start's
  expect_home(flown);
  EXPECT_GT(flown.result.home->flown_m, 5.0);
  // 0.8 m, but for what a flight in calm air errs
  for (const TrajectorySample& sample : flown.result.trajectory) {
    EXPECT_GT(box_m.exteriorDistance(Vec3(sample.T_world_body.translation())), 0.75)
        << sample.time_s;
  }
}

/// On a smooth way the vehicle is beside its legs, and may rest beyond them.
TEST(ReturnHome, LeadsFromAnyPlaceOfASmoothWay) {
  const Overrides around = {"guidance.trajectory=smooth", "vehicle.power.return_home=true",
                            "planner.utility.name=route",
                            "planner.routes.views=[{position_m: [0, 2.8, 1], yaw_deg: -90}]"};
  const double arrival_s = Flown(smoke(around)).result.views.back().time_s;
  for (const double before_s : {1.0, 2.0, 3.0, 4.0}) {
    Overrides cut = around;
    cut.push_back(fmt::format("planner.termination.max_flight_time_s={}", arrival_s - before_s));
    const Flown flown(smoke(cut));
    SCOPED_TRACE(before_s);
    EXPECT_EQ(flown.result.termination, Termination::max_flight_time);
    expect_home(flown);
  }
  // and from where one stops that has no view left to fly to
  for (const auto& [views, seed] : {std::pair(5, 3), {6, 8}, {4, 9}, {6, 11}}) {
    const Flown flown(smoke({"vehicle.power.return_home=true", "planner.utility.name=tour",
                             "planner.preset=takeoff", fmt::format("seed={}", seed),
                             fmt::format("planner.termination.max_iterations={}", views)}));
    SCOPED_TRACE(seed);
    EXPECT_EQ(flown.result.termination, Termination::max_iterations);
    expect_home(flown);
  }
}

/// As the mission has it, which knows longer ways home; and nothing less than it takes is enough.
TEST(Battery, BringsHomeFromEveryViewOfAMissionThatReturns) {
  const double battery_wh = Flown(smoke({"vehicle.power.return_home=true"})).result.energy_wh;
  Flown flown(smoke(
      {"vehicle.power.return_home=true", fmt::format("vehicle.power.battery_wh={}", battery_wh)}));
  EXPECT_EQ(flown.result.termination, Termination::battery);
  ASSERT_GT(flown.result.views.size(), 1U);
  const auto marks = [&] { return view_marks(flown.scenario, flown.result.views); };
  double drawn_wh = 0.0;
  for (const ViewMark& mark : marks()) {
    EXPECT_TRUE(mark.on_one_battery) << *mark.energy_wh;
    EXPECT_GT(*mark.energy_wh, drawn_wh);
    drawn_wh = *mark.energy_wh;
  }
  EXPECT_LT(drawn_wh, flown.result.energy_wh);
  const VehicleConfig& vehicle = flown.scenario.vehicle;
  const ViewPose& last = flown.result.views.back().decision.view;
  const Vec3& home_m = flown.result.start.p_world_m;
  const double needed_wh =
      drawn_wh + leg_energy_wh(vehicle, flown.scenario.guidance, last, {home_m, last.yaw_rad}) +
      landing_energy_wh(vehicle, home_m.z());
  for (const double more_wh : {-1e-9, 1e-9}) {
    flown.scenario.vehicle.power.battery_wh = (needed_wh + more_wh) / 0.8;
    EXPECT_TRUE(marks().front().on_one_battery);
    EXPECT_EQ(marks().back().on_one_battery, more_wh > 0.0);
  }
  // one that is never empty counts as the usual one
  flown.scenario.vehicle.power.battery_wh = 0.0;
  EXPECT_TRUE(marks().back().on_one_battery);
  flown.result.views.back().energy_wh = 0.8 * kUsualBattery_wh;
  EXPECT_FALSE(marks().back().on_one_battery);
}

TEST(Battery, ThatIsLargeEnoughEndsNoMission) {
  const Flown flown(smoke({"vehicle.power.return_home=true", "vehicle.power.battery_wh=100"}));
  EXPECT_EQ(flown.result.termination, Termination::max_iterations);
  expect_home(flown);
  const Flown endless(smoke({"vehicle.power.return_home=true"}));
  EXPECT_EQ(result_sha256(flown.result), result_sha256(endless.result));
  expect_home(Flown(smoke({"vehicle.kind=ideal", "vehicle.power.return_home=true",
                           "planner.termination.max_iterations=3"})));
}

TEST(Battery, ThatDoesNotReachHomeLandsTheVehicleWhereItIs) {
  // nobody foretells a minute of waiting at the end of each leg, until it is given up
  const double battery_wh = 4.0;
  const Flown flown(smoke({"vehicle.power.return_home=true", "vehicle.power.reserve_share=0",
                           fmt::format("vehicle.power.battery_wh={}", battery_wh),
                           "guidance.arrival_speed_m_s=1e-9", "guidance.timeout_s=30"}));
  const MissionResult& result = flown.result;
  EXPECT_EQ(result.termination, Termination::battery);
  ASSERT_TRUE(result.home.has_value());
  EXPECT_FALSE(result.home->reached);
  EXPECT_TRUE(result.home->landed);
  EXPECT_LE(result.energy_wh, battery_wh);
}

// Missions in which something is not as it should be: noise, a wrong pose, a wall, an empty
// battery.

std::vector<std::string> short_mission(std::vector<std::string> overrides) {
  overrides.emplace_back("planner.termination.max_iterations=3");
  return overrides;
}

/// Root mean square distance of the cloud's points from the structure, those within 2 m of it.
double cloud_error_m(const Flown& flight) {
  double sum = 0.0;
  int count = 0;
  for (const Vec3f& point : flight.result.belief.cloud.points_world_m()) {
    const double distance_m = flight.scene.distance_to_structure_m(point.cast<double>(), 2.0);
    if (!std::isfinite(distance_m)) continue;
    sum += distance_m * distance_m;
    ++count;
  }
  return std::sqrt(sum / count);
}

TEST(NoisyMission, BlursTheCloudByAboutTheNoise) {
  // frames alone, seen from about 2 m: 0.0025 z^2 is a centimetre there, and up to 6 cm at 5 m
  const std::vector<std::string> frames_alone = {"planner.profiling.method=none"};
  std::vector<std::string> noisy = frames_alone;
  noisy.emplace_back("cameras.0.noise.model=released");
  const double clean_m = cloud_error_m(Flown(smoke(short_mission(frames_alone))));
  const double noisy_m = cloud_error_m(Flown(smoke(short_mission(noisy))));
  EXPECT_GT(noisy_m, clean_m + 0.002);
  EXPECT_LT(noisy_m, 0.06);
}

TEST(WronglyLocatedMission, BelievesWhatItsEstimateSays) {
  const double true_m = cloud_error_m(Flown(smoke(short_mission({}))));
  const double gnss_m = cloud_error_m(
      Flown(smoke(short_mission({"vehicle.estimate.model=gnss", "start.jitter_m=[0,0,0]"}))));
  EXPECT_LT(true_m, 0.05);
  EXPECT_GT(gnss_m, 0.1);  // half a metre off, partly along the surface
}

TEST(CamerasInFlight, SeeMoreThanTheViewsAlone) {
  const Flown views(smoke(short_mission({})));
  const Flown flight(smoke(short_mission({"cameras.0.rate_hz=2"})));
  ASSERT_GE(views.result.views.size(), 1U);
  EXPECT_GT(flight.result.views.back().cloud_points, views.result.views.back().cloud_points);
}

TEST(EmptyingBattery, EndsTheMissionWithEnoughLeftToLand) {
  const double whole_wh = Flown(smoke()).result.energy_wh;
  for (const double share : {0.2, 0.8}) {  // in the profile, and among the views
    const double battery_wh = share * whole_wh;
    const Flown flight(smoke({fmt::format("vehicle.power.battery_wh={}", battery_wh)}));
    const MissionResult& result = flight.result;
    EXPECT_EQ(result.termination, Termination::battery) << share;
    const double landing_wh = landing_energy_wh(flight.scenario.vehicle,
                                                result.final_state.T_world_body.translation().z());
    EXPECT_GE(landing_wh, 0.0);
    // one tick at less than a kilowatt is the most it can be late
    EXPECT_GE(battery_wh - result.energy_wh, landing_wh - 1000.0 * kTick_s / kJoulesPerWattHour);
    EXPECT_LT(battery_wh - result.energy_wh, landing_wh + 0.01);
  }
}

TEST(HittingTheStructure, EndsTheMissionWhereItHappened) {
  // the structure stands where the profile descends
  TempFolder temp;
  const std::filesystem::path obj = temp.path() / "tower.obj";
  write_file_atomically(obj,
                        "v 3 3 0\nv 3.9 3 0\nv 3.9 3.9 0\nv 3 3.9 0\n"
                        "v 3 3 4\nv 3.9 3 4\nv 3.9 3.9 4\nv 3 3.9 4\n"
                        "f 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\nf 5 6 7 8\n");
  const Flown flight(smoke({fmt::format("structure.file.path={}", obj.string())}));
  EXPECT_EQ(flight.result.termination, Termination::collision);
  const Vec3 p = flight.result.final_state.T_world_body.translation();
  EXPECT_LT(flight.scene.distance_to_structure_m(p, 5.0),
            flight.scenario.vehicle.airframe.hull_radius_m + 0.1);
  EXPECT_TRUE(flight.result.final_state.v_world_m_s.allFinite());
  EXPECT_GT(flight.result.flight_time_s, 0.0);
}

}  // namespace
}  // namespace gnbv
