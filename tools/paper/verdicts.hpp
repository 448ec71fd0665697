// What agrees with the paper and what does not, as pure functions of numbers.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "bench/compare/statistics.hpp"

namespace gnbv {

/// How a mean of ours stands to a number that the paper prints.
enum class Agreement {
  agrees,     // the paper's number lies in our 95 % interval, and that is narrow enough to tell
  close,      // not so, but the two differ by less than matters
  undecided,  // in our interval, which is so wide that it would hold much else
  differs,
  cut  // differs, but a limit of ours ended it before it had as many views as the paper's
};

/// What matters of a difference, and what an interval has to be narrower than to tell anything; in
/// the unit of the numbers.
struct AgreementScale {
  double close = 0.0;
  double wide = 0.0;
};

/// Coverage in percent: 2 and 10 points.
constexpr AgreementScale kCoverageScale = {2.0, 10.0};

/// Amounts: 5 and 20 % of what the paper prints.
AgreementScale scale_of_amount(double printed);

/// One run has no interval: it is close or it differs.
Agreement agreement(const MeanEstimate& ours, double printed, const AgreementScale& scale);

/// Whether two planners stand to each other as in the paper.
enum class PairOrder {
  same,       // our 95 % interval of the paired difference excludes 0 on the paper's side
  reversed,   // on the other side
  undecided,  // it holds 0, or there are fewer than two pairs
  tied        // the paper prints the same number for both
};

/// `printed` is the paper's difference, `ours` the differences over the seeds that both flew.
PairOrder pair_order(double printed, std::span<const double> ours);

/// What becomes of a sentence of the paper.
enum class ClaimVerdict {
  holds,
  partly,
  fails,
  cut  // a limit of ours ended every case before it could be told
};

/// Of a sentence that says "always": in at least 95 % of the cases, at least half of them, fewer.
/// Requires a share in [0, 1].
ClaimVerdict claim_of_share(double share);
/// That rule in words, of cases such as "views".
std::string rule_of_share(std::string_view cases);

/// Spearman's rank correlation of the values with their places: 1 for a series that only rises, -1
/// for one that only falls, 0 for one that is level or has fewer than two values.
double rank_trend(std::span<const double> values);

/// Of a sentence that says a series rises (`sign` 1) or falls (-1): rank_trend() of every run at
/// least 0.8 that way, above 0, or not. Requires a trend.
ClaimVerdict claim_of_trends(std::span<const double> trends, int sign);
/// That rule in words.
std::string rule_of_trends(int sign);

// Words for a page.
std::string_view name_of(Agreement agreement);
std::string_view name_of(PairOrder order);
std::string_view name_of(ClaimVerdict verdict);

}  // namespace gnbv
