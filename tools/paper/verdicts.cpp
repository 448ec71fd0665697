#include "tools/paper/verdicts.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

constexpr double kLevel = 0.05;
constexpr double kHoldsShare = 0.95;
constexpr double kPartlyShare = 0.5;
constexpr double kHoldsTrend = 0.8;

}  // namespace

PaperVerdict agreement(const MeanEstimate& ours, double printed, bool is_coverage) {
  const double close = is_coverage ? 2.0 : 0.05 * std::abs(printed);
  const double wide = is_coverage ? 10.0 : 0.20 * std::abs(printed);
  const double deviation = std::abs(ours.mean - printed);
  const bool is_inside = ours.half_width && deviation <= *ours.half_width;
  if (is_inside && *ours.half_width <= wide) return PaperVerdict::agrees;
  if (deviation <= close) return PaperVerdict::close;
  return is_inside ? PaperVerdict::undecided : PaperVerdict::differs;
}

PaperVerdict order_of_pair(double printed, std::span<const double> ours, std::size_t pairs) {
  if (printed == 0.0) return PaperVerdict::tied;
  const SignedRankTest test = wilcoxon_signed_rank(ours);
  if (static_cast<double>(pairs) * test.p > kLevel) return PaperVerdict::undecided;
  return test.is_above() == (printed > 0.0) ? PaperVerdict::same : PaperVerdict::reversed;
}

PaperVerdict claim_of_share(double share) {
  GNBV_CHECK(share >= 0.0 && share <= 1.0, "a share of {}", share);
  return share >= kHoldsShare    ? PaperVerdict::holds
         : share >= kPartlyShare ? PaperVerdict::partly
                                 : PaperVerdict::fails;
}

std::string rule_of_share(std::string_view cases) {
  return fmt::format("holds in at least {:.0f} % of the {}, partly in at least {:.0f} %",
                     100.0 * kHoldsShare, cases, 100.0 * kPartlyShare);
}

double rank_trend(std::span<const double> values) {
  if (values.size() < 2) return 0.0;
  const std::vector<double> ranks = ranks_of(values);
  const auto n = static_cast<Eigen::Index>(ranks.size());
  const double middle = 0.5 * static_cast<double>(n + 1);
  const Eigen::ArrayXd rank = Eigen::ArrayXd::Map(ranks.data(), n) - middle;
  const Eigen::ArrayXd place = Eigen::ArrayXd::LinSpaced(n, 1.0, static_cast<double>(n)) - middle;
  const double together = (rank * place).sum();
  return together == 0.0 ? 0.0 : together / std::sqrt(rank.square().sum() * place.square().sum());
}

PaperVerdict claim_of_trends(std::span<const double> trends, int sign) {
  GNBV_CHECK(!trends.empty(), "no trend");
  double least = 1.0;
  for (const double trend : trends) least = std::min(least, sign * trend);
  return least >= kHoldsTrend ? PaperVerdict::holds
         : least > 0.0        ? PaperVerdict::partly
                              : PaperVerdict::fails;
}

std::string rule_of_trends(int sign) {
  return fmt::format("holds where every mission's rank correlation is {} or {}, partly where {} 0",
                     sign * kHoldsTrend, sign > 0 ? "more" : "less", sign > 0 ? "above" : "below");
}

}  // namespace gnbv
