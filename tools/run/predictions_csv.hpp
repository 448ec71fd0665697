// predictions.csv: what each view of a tour but the last promised and what it brought, by kind of
// look. How anybody can see where a tour's metres go.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "planner/tour/gains.hpp"

namespace gnbv {

/// Of one view; the look's kind and sums are GainOutcome's.
struct ViewOutcome {
  std::size_t iteration = 0;
  GainOutcome gain;
};

/// Columns: iteration, source (sampled, extrapolated, opposite, frontier), looks before (4: or
/// more), incidence_deg (lower bound of its bin), patches, and in small voxels of
/// planner.tour.detail_m: missing (expected to lack a point), promised, found.
std::string predictions_csv(std::span<const ViewOutcome> outcomes);

/// Throws BadInput naming file and line of whatever is damaged.
std::vector<ViewOutcome> read_predictions_csv(const std::filesystem::path& file);

}  // namespace gnbv
