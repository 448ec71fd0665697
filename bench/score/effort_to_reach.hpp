// How much a mission spent until it covered so much. A mission that ends early spends little, but
// reaches little: this tells the two apart.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "bench/score/run_figures.hpp"

namespace gnbv {

/// Shares of the ceiling (bench/limits/ceiling.hpp: what the cloud can hold at 0.05 m) whose effort
/// is told, and their names.
constexpr std::array<double, 5> kReachShares = {0.80, 0.90, 0.95, 0.98, 0.99};
constexpr std::array<std::string_view, 5> kReachNames = {"0.80", "0.90", "0.95", "0.98", "0.99"};

/// What a mission had spent.
struct EffortSpent {
  double views = 0.0;
  double metres = 0.0;                // as CoverageCurve has them: from the first view on
  double metres_with_profile = 0.0;   // and the planned legs of the profile and on to that view
  double seconds = 0.0;               // as CoverageCurve has them: from the end of the profile on
  double seconds_with_profile = 0.0;  // since the mission began
};

/// Seconds of the curve's entry as its metres count, as people read them: from the first view on,
/// without the way there from the end of the profile. Requires such an entry.
double seconds_of_views(const CoverageCurve& curve, std::size_t entry);

/// What was spent when the cloud first covered so much of the finest voxels: after the profile (no
/// views, and none of the way to the first one) or after a view. Nothing when the mission ended
/// before: it is not reached, however much would have been spent. Requires a curve.
std::optional<EffortSpent> effort_to_reach(const CoverageCurve& curve, const BeforeViews& before,
                                           double coverage);

}  // namespace gnbv
