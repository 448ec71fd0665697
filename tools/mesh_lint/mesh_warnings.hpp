// What a mission should know of the meshes that it flies around.
#pragma once

#include <string>
#include <vector>

#include "scenarios/scenario.hpp"

namespace gnbv {

/// What lint warns of in each mesh file of the structure, a line each, with the keys of this
/// scenario that put it right.
std::vector<std::string> mesh_warnings(const Scenario& scenario, int threads);

}  // namespace gnbv
