#include "bench/score/run_figures.hpp"

#include <gtest/gtest.h>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

/// Coverage of a view as a line through the origin: 0, 0.1, 0.2, ... with two metres and four
/// seconds a view.
CoverageCurve straight_line(int views) {
  CoverageCurve curve;
  for (int view = 0; view <= views; ++view) {
    const double share = 0.1 * view;
    curve.coverage.push_back({share, 0.5 * share, 1.0});
    curve.metres.push_back(2.0 * view);
    curve.seconds.push_back(4.0 * view);
  }
  return curve;
}

TEST(AreaUnderCoverage, OfALineIsItsMiddle) {
  const CoverageCurve curve = straight_line(8);
  for (const auto& [effort, length] :
       {std::pair{Effort::views, 8.0}, {Effort::metres, 16.0}, {Effort::seconds, 32.0}}) {
    EXPECT_NEAR(area_under_coverage(curve, effort, 0, length), 0.4, 1e-12);
    EXPECT_NEAR(area_under_coverage(curve, effort, 1, length), 0.2, 1e-12);
    EXPECT_NEAR(area_under_coverage(curve, effort, 2, length), 1.0, 1e-12);
    // a budget within a step: the line up to there
    EXPECT_NEAR(area_under_coverage(curve, effort, 0, 0.3 * length), 0.12, 1e-12);
    // and past the end, where coverage stays: (0.4 + 0.8) / 2
    EXPECT_NEAR(area_under_coverage(curve, effort, 0, 2.0 * length), 0.6, 1e-12);
  }
}

TEST(AreaUnderCoverage, AStepWithoutEffortHasNoArea) {
  CoverageCurve curve;
  curve.coverage = {{0.0, 0.0, 0.0}, {0.5, 0.5, 0.5}, {1.0, 1.0, 1.0}};
  curve.metres = {0.0, 0.0, 10.0};
  curve.seconds = {0.0, 1.0, 2.0};
  EXPECT_NEAR(area_under_coverage(curve, Effort::metres, 0, 10.0), 0.75, 1e-12);
}

TEST(AreaUnderCoverage, OfTheProfileAloneIsItsCoverage) {
  CoverageCurve curve;
  curve.coverage = {{0.1, 0.2, 0.3}};
  curve.metres = {0.0};
  curve.seconds = {0.0};
  EXPECT_EQ(curve.views(), 0U);
  EXPECT_NEAR(area_under_coverage(curve, Effort::seconds, 1, 7.0), 0.2, 1e-12);
}

TEST(AreaUnderCoverage, NeedsACurveABudgetAndEffortThatGrows) {
  EXPECT_THROW(area_under_coverage({}, Effort::views, 0, 1.0), BrokenInvariant);
  EXPECT_THROW(area_under_coverage(straight_line(2), Effort::views, 0, 0.0), BrokenInvariant);
  CoverageCurve back = straight_line(2);
  back.metres = {0.0, 2.0, 1.0};
  EXPECT_THROW(area_under_coverage(back, Effort::metres, 0, 3.0), BrokenInvariant);
}

}  // namespace
}  // namespace gnbv
