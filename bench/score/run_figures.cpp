#include "bench/score/run_figures.hpp"

#include <algorithm>

#include "bench/score/voxel_set.hpp"
#include "sim/core/error.hpp"

namespace gnbv {

bool is_known(const CoverageCurve& curve, Effort effort) {
  return effort != Effort::wh_with_profile || !curve.energy_wh.empty();
}

double effort_at(const CoverageCurve& curve, const BeforeViews& before, Effort effort,
                 std::size_t entry) {
  switch (effort) {
    case Effort::views:
      return static_cast<double>(entry);
    case Effort::metres:
      return curve.metres[entry];
    case Effort::seconds:
      return curve.seconds[entry];
    case Effort::metres_with_profile:  // after the profile alone without the way on from it
      return before.profile_m + (entry == 0 ? 0.0 : before.transfer_m) + curve.metres[entry];
    case Effort::seconds_with_profile:
      return before.profile_end_s + curve.seconds[entry];
    case Effort::wh_with_profile:
      return curve.energy_wh.at(entry);
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
    const double right = effort_at(curve, {}, effort, i);
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

std::optional<std::size_t> entry_that_covers(const CoverageCurve& curve, double coverage) {
  const auto& shares = curve.coverage;
  GNBV_CHECK(!shares.empty() && curve.metres.size() == shares.size() &&
                 curve.seconds.size() == shares.size(),
             "a curve of {}, {} and {} entries", shares.size(), curve.metres.size(),
             curve.seconds.size());
  const auto reached = std::find_if(shares.begin(), shares.end(),
                                    [&](const auto& by_size) { return by_size[0] >= coverage; });
  if (reached == shares.end()) return std::nullopt;
  return static_cast<std::size_t>(reached - shares.begin());
}

}  // namespace gnbv
