#include <gtest/gtest.h>

#include "scenarios/load.hpp"

namespace gnbv {
namespace {

TEST(PapersSetting, IsThatOfTheBuiltInScenariosWhateverTheReading) {
  for (const std::string name : {"aircraft", "power_plant", "lab_model", "lab_airplane"}) {
    EXPECT_TRUE(has_papers_setting(load_scenario(name, {})));
    EXPECT_TRUE(has_papers_setting(
        load_scenario(name, {"seed=7", "planner.utility.name=isler", "planner.preset=released",
                             "planner.fvs.tries=1", "structure.builtin=smoke"})));
  }
}

TEST(PapersSetting, IsNoneInAnotherWorldNorWithAnotherEnd) {
  for (const std::string set :
       {"obstacles=[{box_m: {min: [20, 20, 0], max: [21, 21, 1]}}]",
        "no_fly=[{min: [20, 20, 0], max: [21, 21, 1]}]",
        "score.region_m={min: [-1, -1, 0], max: [1, 1, 9]}", "wind.gust_w20_m_s=1",
        "vehicle.power.return_home=true", "planner.termination.max_distance_m=2000",
        "planner.termination.max_flight_time_s=9000", "planner.termination.min_new_voxels_per_m=1",
        "planner.termination.max_views_without_new_points=5", "benchmark.stop_at_coverage=0.9"}) {
    EXPECT_FALSE(has_papers_setting(load_scenario("aircraft", {set}))) << set;
  }
  Scenario hilly = load_scenario("aircraft", {});
  hilly.terrain.path = "/hill.ply";
  EXPECT_FALSE(has_papers_setting(hilly));
  EXPECT_FALSE(has_papers_setting(
      load_scenario("aircraft", {"vehicle.estimate={model: gnss, outages: [{start_s: 9}]}"})));
  // what is only told
  EXPECT_TRUE(has_papers_setting(load_scenario("aircraft", {"score.sizes_m=[0.2]"})));
}

TEST(PapersSetting, IsNoneWithOtherViewsSensorsProfileRoomOrName) {
  for (const std::string set :
       {"planner.termination.max_iterations=20", "planner.profiling.method=none",
        "cameras.0.range_max_m=6", "cameras=[{}]", "lidars.0.range_max_m=9",
        "planner.map.resolution_m=0.1", "workspace_m={max: [30, 30, 20]}", "name=mine",
        "vehicle.estimate.model=gnss", "planner.validity.collision_radius_m=1",
        "planner.agvs.step_m=2", "planner.agvs.yaw_step_deg=90"}) {
    EXPECT_FALSE(has_papers_setting(load_scenario("aircraft", {set}))) << set;
  }
}

}  // namespace
}  // namespace gnbv
