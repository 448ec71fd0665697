// What agrees with the paper and what does not, as pure functions of numbers.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

#include "bench/compare/statistics.hpp"

namespace gnbv {

enum class PaperVerdict {
  // how a mean of ours stands to a number that the paper prints
  agrees,     // the paper's number lies in our 95 % interval, and that is narrow enough to tell
  close,      // not so, but the two differ by less than matters
  undecided,  // in our interval, which is so wide that it would hold much else
  differs,
  cut,  // it differs, or cannot be told, but a limit of ours ended missions before the paper's
  // whether two planners stand to each other as in the paper, or else it is undecided
  same,      // the signed-rank test of the paired differences rejects at 5 %, on the paper's side
  reversed,  // on the other side
  tied,      // the paper prints the same number for both
  // what becomes of a sentence of the paper
  holds,
  partly,
  fails
};
NLOHMANN_JSON_SERIALIZE_ENUM(PaperVerdict, {{PaperVerdict::agrees, "agrees"},
                                            {PaperVerdict::close, "close"},
                                            {PaperVerdict::undecided, "undecided"},
                                            {PaperVerdict::differs, "differs"},
                                            {PaperVerdict::cut, "cut short"},
                                            {PaperVerdict::same, "same"},
                                            {PaperVerdict::reversed, "reversed"},
                                            {PaperVerdict::tied, "tied in the paper"},
                                            {PaperVerdict::holds, "holds"},
                                            {PaperVerdict::partly, "partly"},
                                            {PaperVerdict::fails, "does not hold"}})

/// Coverage (%) is close within 2 points, and an interval tells up to a half width of 10; of other
/// amounts it is 5 and 20 % of what the paper prints. One run has no interval: it is close or it
/// differs.
PaperVerdict agreement(const MeanEstimate& ours, double printed, bool is_coverage);

/// `printed` is the paper's difference, `ours` the differences over the seeds that both flew; p is
/// multiplied by `pairs`, how many of planners are compared (Bonferroni). Fewer than six seeds
/// decide nothing.
PaperVerdict order_of_pair(double printed, std::span<const double> ours, std::size_t pairs);

/// Of a sentence that says "always": in at least 95 % of the cases, at least half of them, fewer.
/// Requires a share in [0, 1].
PaperVerdict claim_of_share(double share);
/// That rule in words, of cases such as "views".
std::string rule_of_share(std::string_view cases);

/// Spearman's rank correlation of the values with their places: 1 for a series that only rises, -1
/// for one that only falls, 0 for one that is level or has fewer than two values.
double rank_trend(std::span<const double> values);

/// Of a sentence that says a series rises (`sign` 1) or falls (-1): rank_trend() of every run at
/// least 0.8 that way, above 0, or not. Requires a trend.
PaperVerdict claim_of_trends(std::span<const double> trends, int sign);
/// That rule in words.
std::string rule_of_trends(int sign);

}  // namespace gnbv
