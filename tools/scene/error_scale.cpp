#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/core/text.hpp"
#include "tools/scene/colour.hpp"

namespace gnbv {

ErrorScale error_scale(std::span<const double> errors_m) {
  if (errors_m.empty()) return {};
  std::vector<double> sorted(errors_m.begin(), errors_m.end());
  // the least error that so large a share of them does not exceed
  const auto quantile = [&](double share) {
    const double rank = std::ceil(share * static_cast<double>(sorted.size()) - 1e-9) - 1.0;
    const auto at = sorted.begin() + static_cast<std::ptrdiff_t>(std::max(rank, 0.0));
    std::nth_element(sorted.begin(), at, sorted.end());
    return *at;
  };
  constexpr double kLeast_m = 0.001;
  const double within_m = quantile(0.95);
  return {.most_m = rounded_up_125(std::max(kLeast_m, within_m)),
          .median_m = quantile(0.5),
          .within_m = within_m};
}

}  // namespace gnbv
