#include "bench/score/effort_to_reach.hpp"

#include <algorithm>

#include "sim/core/error.hpp"

namespace gnbv {

double seconds_of_views(const CoverageCurve& curve, std::size_t entry) {
  return entry == 0 ? 0.0 : curve.seconds[entry] - curve.seconds[1];
}

std::optional<EffortSpent> effort_to_reach(const CoverageCurve& curve, const BeforeViews& before,
                                           double coverage) {
  const auto& shares = curve.coverage;
  GNBV_CHECK(!shares.empty() && curve.metres.size() == shares.size() &&
                 curve.seconds.size() == shares.size(),
             "a curve of {}, {} and {} entries", shares.size(), curve.metres.size(),
             curve.seconds.size());
  const auto reached = std::find_if(shares.begin(), shares.end(),
                                    [&](const auto& by_size) { return by_size[0] >= coverage; });
  if (reached == shares.end()) return std::nullopt;
  const auto entry = static_cast<std::size_t>(reached - shares.begin());
  const double transfer_m = entry == 0 ? 0.0 : before.transfer_m;
  return EffortSpent{.views = static_cast<double>(entry),
                     .metres = curve.metres[entry],
                     .metres_with_profile = before.profile_m + transfer_m + curve.metres[entry],
                     .seconds = curve.seconds[entry],
                     .seconds_with_profile = before.profile_end_s + curve.seconds[entry]};
}

}  // namespace gnbv
