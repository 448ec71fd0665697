// Where a seed lets the mission begin.
#pragma once

#include "scenarios/scenario.hpp"
#include "sensors/ray_scene.hpp"

namespace gnbv {

/// Where the mission starts: the scenario's start, moved within its region by the seed, clear of
/// the structure. Throws BadInput when no such pose is found.
ViewPose start_pose(const Scenario& scenario, const RayScene& scene);

}  // namespace gnbv
