// Whether a mission is one of the paper's, so that its figures may stand beside the paper's.
#pragma once

#include "scenarios/scenario.hpp"

namespace gnbv {

/// Whether the scenario has the sensors, the workspace, the resolution, the profile and the number
/// of views of the built-in scenario of its name, which are the paper's. The structure is not
/// asked: it may be a file. Nor are the switches, each a reading of the paper.
bool has_papers_setting(const Scenario& scenario);

}  // namespace gnbv
