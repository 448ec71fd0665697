// The built-in structures by name.
#pragma once

#include <string_view>

#include "sim/mesh/triangle_mesh.hpp"

namespace gnbv {

/// "aircraft", "power_plant", "lab_model", "lab_airplane" or "smoke". Requires a known name:
/// scenarios are checked against the same list.
TriangleMesh make_builtin_structure(std::string_view name);

}  // namespace gnbv
