// Laws of verdicts: who agrees lies within a telling interval, an interval that holds everything
// decides nothing, and turning the signs turns the verdict.
#include "tools/paper/verdicts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace gnbv {
namespace {

TEST(Agreement, NeedsThePapersNumberInATellingInterval) {
  const AgreementScale scale{.close = 2.0, .wide = 10.0};
  EXPECT_EQ(agreement({5, 90.0, 6.0}, 95.0, scale), Agreement::agrees);
  EXPECT_EQ(agreement({5, 90.0, 10.0}, 100.0, scale), Agreement::agrees);
  EXPECT_EQ(agreement({5, 90.0, 4.9}, 95.0, scale), Agreement::differs);
  EXPECT_EQ(agreement({5, 90.0, 10.1}, 95.0, scale), Agreement::undecided);
}

TEST(Agreement, IsCloseByTheDifferenceAlone) {
  const AgreementScale scale{.close = 2.0, .wide = 10.0};
  EXPECT_EQ(agreement({5, 93.0, 0.5}, 95.0, scale), Agreement::close);
  EXPECT_EQ(agreement({2, 94.0, 60.0}, 95.0, scale), Agreement::close);  // tells nothing, yet near
  EXPECT_EQ(agreement({1, 94.0, {}}, 95.0, scale), Agreement::close);    // one seed
  EXPECT_EQ(agreement({1, 92.9, {}}, 95.0, scale), Agreement::differs);
}

TEST(Agreement, OfAnAmountDoesNotDependOnItsUnit) {
  for (const double unit : {1e-3, 1.0, 1e4}) {
    const double printed = 400.0 * unit;
    const AgreementScale scale = scale_of_amount(printed);
    EXPECT_EQ(agreement({3, 350.0 * unit, 60.0 * unit}, printed, scale), Agreement::agrees);
    EXPECT_EQ(agreement({3, 350.0 * unit, 90.0 * unit}, printed, scale), Agreement::undecided);
    EXPECT_EQ(agreement({3, 385.0 * unit, 1.0 * unit}, printed, scale), Agreement::close);
    EXPECT_EQ(agreement({3, 350.0 * unit, 40.0 * unit}, printed, scale), Agreement::differs);
  }
}

TEST(PairOrder, FollowsTheSignsAndDecidesNothingAroundZero) {
  const std::vector<double> above = {3.0, 4.0, 5.0, 4.0};
  const std::vector<double> below = {-3.0, -4.0, -5.0, -4.0};
  const std::vector<double> around = {-3.0, 4.0, -5.0, 6.0};
  EXPECT_EQ(pair_order(1.0, above), PairOrder::same);
  EXPECT_EQ(pair_order(-1.0, below), PairOrder::same);
  EXPECT_EQ(pair_order(-1.0, above), PairOrder::reversed);
  EXPECT_EQ(pair_order(1.0, below), PairOrder::reversed);
  EXPECT_EQ(pair_order(1.0, around), PairOrder::undecided);
  EXPECT_EQ(pair_order(1.0, std::vector<double>{9.0}), PairOrder::undecided);
  EXPECT_EQ(pair_order(1.0, {}), PairOrder::undecided);
  EXPECT_EQ(pair_order(0.0, above), PairOrder::tied);
}

TEST(Claim, OfAlwaysAllowsOneCaseInTwenty) {
  EXPECT_EQ(claim_of_share(1.0), ClaimVerdict::holds);
  EXPECT_EQ(claim_of_share(0.95), ClaimVerdict::holds);
  EXPECT_EQ(claim_of_share(0.94), ClaimVerdict::partly);
  EXPECT_EQ(claim_of_share(0.5), ClaimVerdict::partly);
  EXPECT_EQ(claim_of_share(0.49), ClaimVerdict::fails);
}

TEST(Claim, RulesInWordsNameTheirLimits) {
  EXPECT_EQ(rule_of_share("views"), "holds in at least 95 % of the views, partly in at least 50 %");
  EXPECT_EQ(rule_of_trends(1),
            "holds where every mission's rank correlation is 0.8 or more, partly where above 0");
  EXPECT_EQ(rule_of_trends(-1),
            "holds where every mission's rank correlation is -0.8 or less, partly where below 0");
}

TEST(RankTrend, IsSpearmansAndTurnsWithTheSeries) {
  EXPECT_DOUBLE_EQ(rank_trend(std::vector<double>{1.0, 2.0, 100.0}), 1.0);
  EXPECT_DOUBLE_EQ(rank_trend(std::vector<double>{5.0, 4.0, -1.0}), -1.0);
  EXPECT_DOUBLE_EQ(rank_trend(std::vector<double>{2.0, 2.0, 2.0}), 0.0);
  EXPECT_DOUBLE_EQ(rank_trend(std::vector<double>{2.0}), 0.0);
  EXPECT_DOUBLE_EQ(rank_trend({}), 0.0);
  // by hand: 1 - 6 sum d^2 / (n (n^2 - 1)) = 1 - 6 * 6 / (4 * 15)
  std::vector<double> series = {2.0, 4.0, 1.0, 3.0};
  EXPECT_NEAR(rank_trend(series), 0.0, 1e-12);
  series = {3.0, 1.0, 2.0, 4.0};
  EXPECT_NEAR(rank_trend(series), 1.0 - 6.0 * 6.0 / 60.0, 1e-12);
  std::reverse(series.begin(), series.end());
  EXPECT_NEAR(rank_trend(series), -0.4, 1e-12);
}

TEST(Claim, OfATrendIsThatOfTheWorstRun) {
  EXPECT_EQ(claim_of_trends(std::vector<double>{0.8, 0.99}, 1), ClaimVerdict::holds);
  EXPECT_EQ(claim_of_trends(std::vector<double>{0.79, 0.99}, 1), ClaimVerdict::partly);
  EXPECT_EQ(claim_of_trends(std::vector<double>{0.0, 0.99}, 1), ClaimVerdict::fails);
  EXPECT_EQ(claim_of_trends(std::vector<double>{-0.9, -1.0}, -1), ClaimVerdict::holds);
  EXPECT_EQ(claim_of_trends(std::vector<double>{-0.9, 0.1}, -1), ClaimVerdict::fails);
}

}  // namespace
}  // namespace gnbv
