// Laws of curves: steps, their means, and what happens past an end.
#include "tools/figures/curves.hpp"

#include <limits>

#include "bench/score/run_figures.hpp"
#include "tests/tools/figures/figure_support.hpp"

namespace gnbv {
namespace {

/// Surface counts from the view that saw it: the curve crosses a share where the table says that it
/// was reached.
TEST(Curves, AFigureCrossesAShareWhereTheTableSaysThatItWasReached) {
  RunRecord run = covered_record(1, {0.1, 0.4, 0.7, 0.9, 0.95});
  run.figures->curve.metres = {0.0, 0.0, 3.5, 13.2, 20.0};
  const StepCurve steps = *coverage_steps(*run.figures, Effort::metres, 0.05);
  for (const double share : {0.35, 0.5, 0.8, 0.95}) {
    const CoverageCurve& curve = run.figures->curve;
    const double reached_m = curve.metres[*entry_that_covers(curve, share)];
    EXPECT_GE(steps.at(reached_m), 100.0 * share);
    if (reached_m == 0.0) continue;
    EXPECT_LT(steps.at(reached_m - 1e-9), 100.0 * share);
  }
  EXPECT_EQ(steps.at(10.7), 70.0);
  EXPECT_EQ(steps.at(1e9), 95.0);  // stays past its end
}

/// The way from the profile to the first view is in no distance, and in no time either.
TEST(Curves, TimeAndDistanceBothBeginWithTheFirstView) {
  RunRecord run = covered_record(1, {0.2, 0.4, 1.0});
  run.figures->curve.metres = {0.0, 0.0, 7.0};
  run.figures->curve.seconds = {0.0, 60.0, 75.0};
  using Values = std::vector<double>;
  EXPECT_EQ(coverage_steps(*run.figures, Effort::metres, 0.05)->x, (Values{0, 0, 7}));
  EXPECT_EQ(coverage_steps(*run.figures, Effort::seconds, 0.05)->x, (Values{0, 0, 15}));
  EXPECT_EQ(coverage_steps(*run.figures, Effort::views, 0.05)->x, (Values{0, 1, 2}));
  // from take-off both have what went before
  run.figures->before = {.profile_m = 100.0, .transfer_m = 20.0, .profile_end_s = 30.0};
  EXPECT_EQ(coverage_steps(*run.figures, Effort::metres_with_profile, 0.05)->x,
            (Values{100, 120, 127}));
  EXPECT_EQ(coverage_steps(*run.figures, Effort::seconds_with_profile, 0.05)->x,
            (Values{30, 90, 105}));
  EXPECT_FALSE(coverage_steps(*run.figures, Effort::wh_with_profile, 0.05));
  EXPECT_FALSE(coverage_steps(*run.figures, Effort::views, 0.2));
  run.figures->more = {{.size_m = 0.2, .curve = {0.5, 0.6, 0.7}}};
  EXPECT_EQ(coverage_steps(*run.figures, Effort::views, 0.2)->y, (Values{50, 60, 70}));
}

double brute_force(const StepCurve& curve, double x) {
  double y = curve.y.front();
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    if (curve.x[i] <= x) y = curve.y[i];
  }
  return y;
}

TEST(Curves, MeansAreThoseOfEveryRunWithStudentsInterval) {
  const std::vector<StepCurve> curves = {
      {{0, 0, 2, 4}, {10, 20, 40, 50}}, {{0, 1, 3}, {20, 60, 80}}, {{0, 2, 7}, {30, 31, 90}}};
  const MeanCurve mean = mean_curve(curves);
  EXPECT_EQ(mean.x, (std::vector<double>{0, 1, 2, 3, 4, 7}));  // nothing at one x twice
  for (std::size_t i = 0; i < mean.x.size(); ++i) {
    double sum = 0.0, squares = 0.0;
    for (const StepCurve& curve : curves) sum += brute_force(curve, mean.x[i]) / 3.0;
    for (const StepCurve& curve : curves) {
      squares += std::pow(brute_force(curve, mean.x[i]) - sum, 2) / 2.0;
    }
    EXPECT_NEAR(mean.y[i].mean, sum, 1e-12);
    EXPECT_NEAR(*mean.y[i].half_width, 4.302652730 * std::sqrt(squares / 3.0),
                1e-6);  // t(0.975, 2)
  }
  EXPECT_NEAR(mean.end_x, 14.0 / 3.0, 1e-12);
  EXPECT_NEAR(mean.end_y, (50.0 + 80.0 + 31.0) / 3.0, 1e-12);
  EXPECT_EQ(mean.shortest_x, 3.0);
  EXPECT_EQ(mean.longest_x, 7.0);
}

TEST(Curves, AMeanOfManyViewsHasAThousandPointsEachOnTheCurve) {
  std::vector<double> values;
  for (int i = 0; i < 5000; ++i) values.push_back(std::sqrt(i));
  const std::vector<StepCurve> curves = {steps_over_views(values)};
  const MeanCurve mean = mean_curve(curves);
  ASSERT_EQ(mean.x.size(), 1000U);
  EXPECT_EQ(mean.x.front(), 1.0);
  EXPECT_EQ(mean.x.back(), 5000.0);
  for (std::size_t i = 0; i < 1000; i += 111) {
    EXPECT_EQ(mean.y[i].mean, values[static_cast<std::size_t>(mean.x[i]) - 1]);
  }
}

TEST(Curves, MovingMeansShrinkAtTheEndsAndSkipWhatIsNotKnown) {
  const std::vector<double> values = {1, 2, 4, 8, 16};
  EXPECT_EQ(moving_mean(values, 3), (std::vector<double>{1, 7.0 / 3, 14.0 / 3, 28.0 / 3, 16}));
  EXPECT_EQ(moving_mean(values, 1), values);
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> with_gaps = moving_mean(std::vector{unknown, 4.0, unknown, 2.0}, 3);
  EXPECT_TRUE(std::isnan(with_gaps[0]));  // alone in its window
  EXPECT_EQ(with_gaps[1], 4.0);
  EXPECT_EQ(with_gaps[2], 3.0);
}

TEST(Curves, FrontierPhasesAreTheRowsOfTheirSampler) {
  const std::vector<Phase> phases = frontier_phases(scored_record().views);
  ASSERT_EQ(phases.size(), 2U);
  EXPECT_EQ(phases[0].first, 4);
  EXPECT_EQ(phases[0].last, 6);
  EXPECT_EQ(phases[1].first, 11);
  EXPECT_EQ(phases[1].last, 11);
}

}  // namespace
}  // namespace gnbv
