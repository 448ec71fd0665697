// How well the vehicle kept to its legs, for runs in wind.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "tools/plots/gnuplot.hpp"
#include "tools/run/run_record.hpp"

namespace gnbv {

/// "tracking": over the time of the views, how far the vehicle truly was from the straight legs
/// that were checked for it, beside what the collision radius leaves beyond the hull (the safety
/// margin); and its tilt.
/// Nothing for a run without two views, or without its path.
std::optional<Plot> tracking_plot(const RunRecord& record);

/// The points of the way from the view before to that view, both included. Requires view > 0.
std::vector<Vec3> way_to_view(std::span<const ViewRecord> views, std::size_t view);

/// Distance to the nearest point of the way through these points. Requires one at least.
double distance_to_way_m(const Vec3& p_world_m, std::span<const Vec3> way_world_m);

}  // namespace gnbv
