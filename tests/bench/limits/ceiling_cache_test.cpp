// What a ceiling depends on, and what not.
#include "bench/limits/ceiling_cache.hpp"

#include <gtest/gtest.h>

#include "scenarios/load.hpp"
#include "tools/mission/load_world.hpp"
#include "tools/mission/start_pose.hpp"

namespace gnbv {
namespace {

std::string content_of(const std::string& set) {
  return to_yaml(what_a_ceiling_depends_on(load_scenario("smoke", {set})));
}

std::string key_of(const Scenario& scenario) {
  std::vector<std::string> warnings;
  const World world = load_world(scenario, warnings);
  const RayScene scene(world);
  const ViewPose start = start_pose(scenario, scene);
  return ceiling_key(scenario, world, find_legal_viewpoints(scenario, scene, start, 2));
}

TEST(WhatACeilingDependsOn, HasTheSameKeyOfTheCache) {
  const Scenario scenario = load_scenario(
      "smoke", {"cameras.0.noise.model=nguyen", "cameras.0.name=x", "cameras.0.rate_hz=3",
                "planner.utility.name=isler", "planner.validity.collision_radius_m=0.6",
                "planner.validity.z_min_m=0.9", "planner.cloud.leaf_m=0.07",
                "planner.floor_z_m=0.2", "planner.profiling.method=circular", "seed=3",
                "obstacles=[{box_m: {min: [2, 2, 0], max: [3, 3, 1]}}]",
                "no_fly=[{min: [-3, 2, 0], max: [-2, 3, 1]}]",
                "score.region_m={min: [-1, -1, 0], max: [1, 1, 1]}"});
  EXPECT_EQ(key_of(what_a_ceiling_depends_on(scenario)), key_of(scenario));
}

TEST(WhatACeilingDependsOn, IsNotWhatOnlyDecidesBetweenViews) {
  const std::string plain = content_of("seed=1");
  for (const char* set :
       {"planner.utility.name=isler", "planner.termination.max_iterations=3",
        "planner.agvs.step_m=0.3", "planner.fvs.enabled=false", "planner.map.prob_hit=0.6",
        "planner.validity.path=astar", "cameras.0.noise.model=nguyen", "cameras.0.rate_hz=2",
        "guidance.path_speed_m_s=2", "vehicle.kind=ideal", "benchmark.stop_at_coverage=0.5",
        "cameras.0.drop_probability=0.3", "wind.mean_m_s=[1, 0, 0]", "score.sizes_m=[0.2]"}) {
    EXPECT_EQ(content_of(set), plain) << set;
  }
  for (const char* set :
       {"seed=2", "cameras.0.range_max_m=4", "cameras.0.pitch_deg=9", "lidars.0.range_max_m=4",
        "planner.cloud.leaf_m=0.1", "planner.map.resolution_m=0.1", "planner.floor_z_m=0.1",
        "planner.validity.collision_radius_m=0.7", "planner.validity.z_min_m=0.9",
        "planner.profiling.method=none", "workspace_m.max=[5, 4, 5]", "structure.ground=false",
        "structure.builtin=lab_model", "start.position_m=[0, -3, 1.2]",
        "obstacles=[{box_m: {min: [2, 2, 0], max: [3, 3, 1]}}]",
        "no_fly=[{min: [2, 2, 0], max: [3, 3, 1]}]",
        "score.region_m={min: [-1, -1, 0], max: [1, 1, 1]}"}) {
    EXPECT_NE(content_of(set), plain) << set;
  }
}

}  // namespace
}  // namespace gnbv
