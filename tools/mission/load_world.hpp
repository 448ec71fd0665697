// From the scenario's structure section to the world it names.
#pragma once

#include "scenarios/scenario.hpp"
#include "sim/world.hpp"

namespace gnbv {

/// Generates the built-in structure or reads the mesh file. Throws BadInput when the structure
/// cannot be had or does not lie inside the workspace.
World load_world(const Scenario& scenario);

}  // namespace gnbv
