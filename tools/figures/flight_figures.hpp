// Figures of a flight: where the vehicle was, and how well it kept to its legs.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "tools/figures/figure.hpp"
#include "tools/run/run_record.hpp"

namespace gnbv {

/// "flight": position, attitude, speed and distance from the leg over the time of the views, from
/// trajectory.tum. Nothing for a run without two views, or without its path.
std::optional<Figure> flight_figure(const RunRecord& record);

/// "tracking": over the time of the views, how far the vehicle truly was from the straight legs
/// that were checked for it, beside what the collision radius leaves beyond the hull (the safety
/// margin); and its tilt. Nothing for a run without two views, or without its path.
std::optional<Figure> tracking_figure(const RunRecord& record);

/// A line of yaws in [-180, 180] deg: what goes past 180 is drawn on to 190 before the line breaks
/// (NaN) and goes on at the other end, so that a vehicle that looks that way does not jump to and
/// fro.
Series yaw_series(std::span<const double> times_s, std::span<const double> yaws_deg);

/// Where each of 240 even steps of time begins among many samples, and their end; nothing of few,
/// which are drawn as they are.
std::vector<std::size_t> steps_of(std::span<const double> times_s);

/// Samples over time: as they are, or of many the mean of each step, and a band from that share of
/// its samples to that one.
Series trace(std::string name, const std::vector<double>& times_s,
             const std::vector<double>& values, std::size_t colour, double from = 0.0,
             double to = 1.0);

}  // namespace gnbv
