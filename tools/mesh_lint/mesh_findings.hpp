// From the figures of a mesh to sentences about it.
#pragma once

#include <vector>

#include "tools/mesh_lint/mesh_report.hpp"

namespace gnbv {

/// What the figures mean for a mission of this scenario; `report.findings` is not looked at.
std::vector<Finding> findings_of(const MeshReport& report, const Scenario& scenario,
                                 bool bounds_auto);

}  // namespace gnbv
