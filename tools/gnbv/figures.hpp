// From an executed mission to the figures that the paper's tables compare.
#pragma once

#include "bench/run_figures.hpp"
#include "tools/gnbv/execute.hpp"

namespace gnbv {

RunFigures figures_of(const Scenario& scenario, const ExecutedMission& mission);

}  // namespace gnbv
