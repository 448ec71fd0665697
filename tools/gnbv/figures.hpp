// From an executed mission to the figures that the paper's tables compare.
#pragma once

#include "bench/paper_table.hpp"
#include "tools/gnbv/execute.hpp"

namespace gnbv {

MissionFigures figures_of(const Scenario& scenario, const ExecutedMission& mission);

}  // namespace gnbv
