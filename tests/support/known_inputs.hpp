// What a mission is given whose planner knows the structure.
#pragma once

#include "bench/limits/oracle.hpp"
#include "planner/planners.hpp"
#include "tools/mission/mission.hpp"
#include "tools/mission/start_pose.hpp"

namespace gnbv {

/// Of all other planners nothing. Keeps references to all but the world.
inline MissionInputs known_inputs(const Scenario& scenario, const World& world,
                                  const RayScene& scene, const SurfaceReference& reference) {
  MissionInputs inputs;
  if (traits_of(scenario.planner).knows_structure) {
    inputs.sources.route =
        plan_oracle(scenario, world, scene, reference, start_pose(scenario, scene), 2);
  }
  return inputs;
}

}  // namespace gnbv
