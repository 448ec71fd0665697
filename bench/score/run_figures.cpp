#include "bench/score/run_figures.hpp"

#include <algorithm>

#include "bench/score/voxel_set.hpp"
#include "sim/core/error.hpp"

namespace gnbv {

double effort_at(const CoverageCurve& curve, Effort effort, std::size_t entry) {
  switch (effort) {
    case Effort::views:
      return static_cast<double>(entry);
    case Effort::metres:
      return curve.metres[entry];
    case Effort::seconds:
      return curve.seconds[entry];
  }
  GNBV_CHECK(false, "effort {}", static_cast<int>(effort));
}

double area_under_coverage(const CoverageCurve& curve, Effort effort, std::size_t size,
                           double budget) {
  const std::size_t entries = curve.coverage.size();
  GNBV_CHECK(entries > 0 && curve.metres.size() == entries && curve.seconds.size() == entries,
             "a curve of {}, {} and {} entries", entries, curve.metres.size(),
             curve.seconds.size());
  GNBV_CHECK(budget > 0.0 && size < kCoverageSizes_m.size(), "budget {}, size {}", budget, size);
  double area = 0.0;
  double left = 0.0;
  for (std::size_t i = 1; i < entries && left < budget; ++i) {
    const double right = effort_at(curve, effort, i);
    GNBV_CHECK(right >= left, "effort goes back from {} to {} at view {}", left, right, i);
    area += (std::min(right, budget) - left) * curve.coverage[i - 1][size];
    left = right;
  }
  if (left < budget) area += (budget - left) * curve.coverage.back()[size];
  return area / budget;
}

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
