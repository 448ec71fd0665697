#include "tools/paper/verdicts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

constexpr double kHoldsShare = 0.95;
constexpr double kPartlyShare = 0.5;
constexpr double kHoldsTrend = 0.8;

}  // namespace

AgreementScale scale_of_amount(double printed) {
  return {0.05 * std::abs(printed), 0.20 * std::abs(printed)};
}

Agreement agreement(const MeanEstimate& ours, double printed, const AgreementScale& scale) {
  const double deviation = std::abs(ours.mean - printed);
  const bool is_inside = ours.half_width && deviation <= *ours.half_width;
  if (is_inside && *ours.half_width <= scale.wide) return Agreement::agrees;
  if (deviation <= scale.close) return Agreement::close;
  return is_inside ? Agreement::undecided : Agreement::differs;
}

PairOrder pair_order(double printed, std::span<const double> ours) {
  if (printed == 0.0) return PairOrder::tied;
  if (ours.size() < 2) return PairOrder::undecided;
  const MeanEstimate difference = estimate_mean(ours);
  if (std::abs(difference.mean) <= *difference.half_width) return PairOrder::undecided;
  return (difference.mean > 0.0) == (printed > 0.0) ? PairOrder::same : PairOrder::reversed;
}

ClaimVerdict claim_of_share(double share) {
  GNBV_CHECK(share >= 0.0 && share <= 1.0, "a share of {}", share);
  return share >= kHoldsShare    ? ClaimVerdict::holds
         : share >= kPartlyShare ? ClaimVerdict::partly
                                 : ClaimVerdict::fails;
}

std::string rule_of_share(std::string_view cases) {
  return fmt::format("holds in at least {:.0f} % of the {}, partly in at least {:.0f} %",
                     100.0 * kHoldsShare, cases, 100.0 * kPartlyShare);
}

double rank_trend(std::span<const double> values) {
  const std::vector<double> ranks = ranks_of(values);
  const double middle = 0.5 * static_cast<double>(values.size() + 1);
  double together = 0.0;
  double of_ranks = 0.0;
  double of_places = 0.0;
  for (std::size_t i = 0; i < ranks.size(); ++i) {
    const double rank = ranks[i] - middle;
    const double place = static_cast<double>(i + 1) - middle;
    together += rank * place;
    of_ranks += rank * rank;
    of_places += place * place;
  }
  return of_ranks > 0.0 ? together / std::sqrt(of_ranks * of_places) : 0.0;
}

ClaimVerdict claim_of_trends(std::span<const double> trends, int sign) {
  GNBV_CHECK(!trends.empty(), "no trend");
  double least = 1.0;
  for (const double trend : trends) least = std::min(least, sign * trend);
  return least >= kHoldsTrend ? ClaimVerdict::holds
         : least > 0.0        ? ClaimVerdict::partly
                              : ClaimVerdict::fails;
}

std::string rule_of_trends(int sign) {
  return fmt::format("holds where every mission's rank correlation is {} or {}, partly where {} 0",
                     sign * kHoldsTrend, sign > 0 ? "more" : "less", sign > 0 ? "above" : "below");
}

std::string_view name_of(Agreement agreement) {
  switch (agreement) {
    case Agreement::agrees:
      return "agrees";
    case Agreement::close:
      return "close";
    case Agreement::undecided:
      return "undecided";
    case Agreement::differs:
      return "differs";
    case Agreement::cut:
      return "cut short";
  }
  return "";
}

std::string_view name_of(PairOrder order) {
  switch (order) {
    case PairOrder::same:
      return "same";
    case PairOrder::reversed:
      return "reversed";
    case PairOrder::undecided:
      return "undecided";
    case PairOrder::tied:
      return "tied in the paper";
  }
  return "";
}

std::string_view name_of(ClaimVerdict verdict) {
  switch (verdict) {
    case ClaimVerdict::holds:
      return "holds";
    case ClaimVerdict::partly:
      return "partly";
    case ClaimVerdict::fails:
      return "does not hold";
    case ClaimVerdict::cut:
      return "cut short";
  }
  return "";
}

}  // namespace gnbv
