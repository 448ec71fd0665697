// The chances that a large-neighbourhood search over tours of views takes (Shaw 1998; Ropke,
// Pisinger 2006).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planner/tour/waypoints.hpp"
#include "sim/core/rng.hpp"

namespace gnbv {

/// 2 to 15 of the chosen views: some in a row, the nearest of one, or any. `node_of`: of each view;
/// `chosen` is not empty.
std::vector<std::uint32_t> views_to_remove(std::span<const std::uint32_t> chosen,
                                           std::span<const std::uint32_t> node_of,
                                           const Waypoints& waypoints, const RowOf& row_m,
                                           Rng& rng);

/// What each view's gain per metre is multiplied by; nothing, every other time: by 1. Without it
/// the best view always wins, and a tour of two views that a third one outbids is never found.
std::vector<double> perturbation_weights(std::size_t views, Rng& rng);

}  // namespace gnbv
