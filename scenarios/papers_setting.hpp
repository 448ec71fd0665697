// Whether a mission is one of the paper's, so that its figures may stand beside the paper's.
#pragma once

#include "scenarios/scenario.hpp"

namespace gnbv {

/// Whether the scenario has the values of the built-in scenario of its name, which are the paper's,
/// wherever fields_*.cpp say that they belong to the paper's setting: sensors, estimate, workspace,
/// resolution, steps of the grid, collision radius, profile, number of views. The structure is not
/// asked: it may be a file. Nor are the switches, each a reading of the paper.
bool has_papers_setting(const Scenario& scenario);

}  // namespace gnbv
