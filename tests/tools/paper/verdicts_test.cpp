// Laws of verdicts: who agrees lies within a telling interval, an interval that holds everything
// decides nothing, and turning the signs turns the verdict.
#include "tools/paper/verdicts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace gnbv {
namespace {

TEST(Agreement, NeedsThePapersNumberInATellingInterval) {
  EXPECT_EQ(agreement({5, 90.0, 6.0}, 95.0, true), PaperVerdict::agrees);
  EXPECT_EQ(agreement({5, 90.0, 10.0}, 100.0, true), PaperVerdict::agrees);
  EXPECT_EQ(agreement({5, 90.0, 4.9}, 95.0, true), PaperVerdict::differs);
  EXPECT_EQ(agreement({5, 90.0, 10.1}, 95.0, true), PaperVerdict::undecided);
}

TEST(Agreement, IsCloseByTheDifferenceAlone) {
  EXPECT_EQ(agreement({5, 93.0, 0.5}, 95.0, true), PaperVerdict::close);
  EXPECT_EQ(agreement({2, 94.0, 60.0}, 95.0, true),
            PaperVerdict::close);                                        // tells nothing, yet near
  EXPECT_EQ(agreement({1, 94.0, {}}, 95.0, true), PaperVerdict::close);  // one seed
  EXPECT_EQ(agreement({1, 92.9, {}}, 95.0, true), PaperVerdict::differs);
}

TEST(Agreement, OfAnAmountDoesNotDependOnItsUnit) {
  for (const double unit : {1e-3, 1.0, 1e4}) {
    const auto of = [&](double mean, double half_width) {
      return agreement({3, mean * unit, half_width * unit}, 400.0 * unit, false);
    };
    EXPECT_EQ(of(350.0, 60.0), PaperVerdict::agrees);
    EXPECT_EQ(of(350.0, 90.0), PaperVerdict::undecided);
    EXPECT_EQ(of(385.0, 1.0), PaperVerdict::close);
    EXPECT_EQ(of(350.0, 40.0), PaperVerdict::differs);
  }
}

TEST(PairOrder, FollowsTheSignsAndDecidesNothingWhereTheTestDoesNot) {
  const std::vector<double> above = {3.0, 4.0, 5.0, 4.5, 3.5, 6.0};
  const std::vector<double> below = {-3.0, -4.0, -5.0, -4.5, -3.5, -6.0};
  const std::vector<double> around = {-3.0, 4.0, -5.0, 6.0, 3.5, -2.0};
  const std::vector<double> five = {4.0, 4.1, 4.2, 4.3, 4.4};  // Student's interval excludes 0
  EXPECT_EQ(order_of_pair(1.0, above, 1), PaperVerdict::same);
  EXPECT_EQ(order_of_pair(-1.0, below, 1), PaperVerdict::same);
  EXPECT_EQ(order_of_pair(-1.0, above, 1), PaperVerdict::reversed);
  EXPECT_EQ(order_of_pair(1.0, below, 1), PaperVerdict::reversed);
  EXPECT_EQ(order_of_pair(1.0, above, 2), PaperVerdict::undecided);  // p = 2 x 0.03125
  EXPECT_EQ(order_of_pair(1.0, around, 1), PaperVerdict::undecided);
  EXPECT_EQ(order_of_pair(1.0, five, 1), PaperVerdict::undecided);
  EXPECT_EQ(order_of_pair(1.0, {}, 1), PaperVerdict::undecided);
  EXPECT_EQ(order_of_pair(0.0, above, 1), PaperVerdict::tied);
}

TEST(Claim, OfAlwaysAllowsOneCaseInTwenty) {
  EXPECT_EQ(claim_of_share(1.0), PaperVerdict::holds);
  EXPECT_EQ(claim_of_share(0.95), PaperVerdict::holds);
  EXPECT_EQ(claim_of_share(0.94), PaperVerdict::partly);
  EXPECT_EQ(claim_of_share(0.5), PaperVerdict::partly);
  EXPECT_EQ(claim_of_share(0.49), PaperVerdict::fails);
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
  EXPECT_EQ(claim_of_trends(std::vector<double>{0.8, 0.99}, 1), PaperVerdict::holds);
  EXPECT_EQ(claim_of_trends(std::vector<double>{0.79, 0.99}, 1), PaperVerdict::partly);
  EXPECT_EQ(claim_of_trends(std::vector<double>{0.0, 0.99}, 1), PaperVerdict::fails);
  EXPECT_EQ(claim_of_trends(std::vector<double>{-0.9, -1.0}, -1), PaperVerdict::holds);
  EXPECT_EQ(claim_of_trends(std::vector<double>{-0.9, 0.1}, -1), PaperVerdict::fails);
}

}  // namespace
}  // namespace gnbv
