// Where the vehicle was, how it was turned, how fast it flew, and how far off its legs.
#pragma once

#include <optional>

#include "tools/plots/gnuplot.hpp"
#include "tools/run_files/run_record.hpp"

namespace gnbv {

/// "flight": position, attitude, speed and distance from the leg over the time of the views, from
/// trajectory.tum. Nothing for a run without two views, or without its path.
std::optional<Plot> flight_plot(const RunRecord& record);

}  // namespace gnbv
