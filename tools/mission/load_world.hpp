// From the scenario's structure section to the world it names.
#pragma once

#include <string>
#include <vector>

#include "scenarios/scenario.hpp"
#include "sim/mesh/world.hpp"

namespace gnbv {

/// Generates the built-in structure or reads the mesh file, wherever it lies; what the file's
/// reader had to leave out is appended to `warnings`, a sentence each. Throws BadInput when the
/// structure cannot be had.
TriangleMesh load_structure(const Scenario& scenario, std::vector<std::string>& warnings);

/// Whether a mesh lies in the scenario's workspace. Written coordinates are rounded: a millimetre
/// outside is no fault.
bool is_inside_workspace(const Scenario& scenario, const Box3& mesh_m);

/// The world with that structure. Throws BadInput, too, when it does not lie inside the workspace.
World load_world(const Scenario& scenario, std::vector<std::string>& warnings);

}  // namespace gnbv
