// Where the vehicle was, how it was turned, how fast it flew, and how far off its legs.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>

#include "tools/plots/gnuplot.hpp"
#include "tools/run/run_record.hpp"

namespace gnbv {

/// "flight": position, attitude, speed and distance from the leg over the time of the views, from
/// trajectory.tum. Nothing for a run without two views, or without its path.
std::optional<Plot> flight_plot(const RunRecord& record);

/// The block `yaw` of times and yaws in [-180, 180] deg, a blank line where the line breaks: what
/// goes past 180 is drawn on to 190 before it appears at the other end, so that a vehicle that
/// looks that way does not jump to and fro.
std::string yaw_block(std::span<const std::array<double, 2>> time_yaw);

}  // namespace gnbv
