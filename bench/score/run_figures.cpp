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

}  // namespace gnbv
