// From the scenario's structure, terrain and obstacles to the world they name.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scenarios/scenario.hpp"
#include "sensors/ray_scene.hpp"
#include "sim/mesh/world.hpp"

namespace gnbv {

/// Generates the built-in structure or reads the mesh files, wherever they lie; what their reader
/// had to leave out is appended to `warnings`, a sentence each. Throws BadInput when the structure
/// cannot be had. Several files are one mesh, in the order of the scenario.
TriangleMesh load_structure(const Scenario& scenario, std::vector<std::string>& warnings);

/// Puts the obstacles, the terrain and the ground around the structure; the rest as above.
void load_surroundings(const Scenario& scenario, World& world, std::vector<std::string>& warnings);

/// What sensors see without the structure and the plane ground; nothing where that is nothing.
std::shared_ptr<const RayScene> scene_around(const Scenario& scenario);

/// The world, wherever the structure lies in it.
World load_world_anywhere(const Scenario& scenario, std::vector<std::string>& warnings);

/// Whether a mesh lies in the scenario's workspace. Written coordinates are rounded: a millimetre
/// outside is no fault.
bool is_inside_workspace(const Scenario& scenario, const Box3& mesh_m);

/// The same. Throws BadInput, too, when the structure does not lie inside the workspace; what is
/// around it may reach beyond.
World load_world(const Scenario& scenario, std::vector<std::string>& warnings);

}  // namespace gnbv
