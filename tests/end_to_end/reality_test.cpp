// Missions in which something is not as it should be: noise, a wrong pose, a wall, an empty
// battery.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "sim/core/file.hpp"
#include "sim/flight/guidance.hpp"
#include "sim/flight/rotors.hpp"
#include "tests/support/flown.hpp"
#include "tests/support/temp_folder.hpp"

namespace gnbv {
namespace {

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

TEST(NoisyMission, IsAnotherWithAnotherSeed) {
  const auto hash_of = [](const char* seed) {
    return result_sha256(
        Flown(smoke(short_mission({"cameras.0.noise.model=nguyen", "lidars.0.range_sigma_m=0.02",
                                   "start.jitter_m=[0,0,0]", seed})))
            .result);
  };
  EXPECT_NE(hash_of("seed=1"), hash_of("seed=2"));
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
