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

struct Flown {
  explicit Flown(const Scenario& flown_scenario, const MissionInputs& inputs = {}, int threads = 2)
      : scenario(flown_scenario),
        world(load_world(scenario, warnings)),
        scene(world),
        result(run_mission(scenario, world, scene, inputs, threads)) {}

  Scenario scenario;
  std::vector<std::string> warnings;
  World world;
  RayScene scene;
  MissionResult result;
};

}  // namespace gnbv
