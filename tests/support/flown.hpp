// A whole mission, flown by the constructor.
#pragma once

#include <string>
#include <vector>

#include "scenarios/load.hpp"
#include "tools/mission/load_world.hpp"
#include "tools/mission/mission.hpp"

namespace gnbv {

inline Scenario smoke(const std::vector<std::string>& overrides = {}) {
  return load_scenario("smoke", overrides);
}

/// What stands in it, without what its reader had to say.
inline World world_of(const Scenario& scenario) {
  std::vector<std::string> warnings;
  return load_world(scenario, warnings);
}

struct Flown {
  explicit Flown(const Scenario& flown_scenario, const MissionInputs& inputs = {}, int threads = 2)
      : scenario(flown_scenario),
        world(world_of(scenario)),
        scene(world),
        result(run_mission(scenario, world, scene, inputs, threads)) {}

  Scenario scenario;
  World world;
  RayScene scene;
  MissionResult result;
};

}  // namespace gnbv
