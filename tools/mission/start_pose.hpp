// Where a seed lets the mission begin.
#pragma once

#include <string>

#include "scenarios/scenario.hpp"
#include "sensors/ray_scene.hpp"

namespace gnbv {

/// Where the mission starts: the scenario's start, moved within its region by the seed, clear of
/// the structure, of what stands around it and of the no_fly boxes. Throws BadInput when no such
/// pose is found.
ViewPose start_pose(const Scenario& scenario, const RayScene& scene);

/// "the start: [0.10, -2.80, 1.20] ..." for one that start.jitter_m or jitter_yaw_deg moved, which
/// else nobody would see; "" for one that is where the scenario says.
std::string moved_start_note(const Scenario& scenario, const ViewPose& start);

/// Throws BadInput when the structure encloses the start, so that a profile around the structure
/// cannot be flown. A workspace that lies within the structure has no outside: all is well.
void need_way_out(const Scenario& scenario, const RayScene& scene, const Box3& structure_m,
                  const ViewPose& start, int threads);

/// With start.on_ground, throws BadInput when there is no ground below the start, or something
/// solid on the way up.
void need_way_up(const Scenario& scenario, const World& world, const RayScene& scene,
                 const ViewPose& start);

/// What to say when the structure or what stands around it is in the way of the profile's legs, of
/// an adaptive one as far up as it may climb; "" otherwise, and for a vehicle without a body.
std::string profile_warning(const Scenario& scenario, const RayScene& scene, const ViewPose& start);

}  // namespace gnbv
