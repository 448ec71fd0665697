// Laws of the figure of paired differences.
#include "tools/figures/forest_figure.hpp"

#include "tests/tools/figures/figure_support.hpp"

namespace gnbv {
namespace {

ComparedRun compared(const std::string& method, int seed, double coverage, double straight_m) {
  ComparedRun run{.scenario = "smoke",
                  .method = method,
                  .seed = static_cast<std::uint64_t>(seed),
                  .figures = {}};
  run.figures.coverage_final = {coverage, coverage, coverage};
  run.figures.straight_m = straight_m;
  return run;
}

/// 95 % interval of the mean of three numbers that are so far apart.
double half_width(double apart) { return 4.302652730 * apart / std::sqrt(3.0); }

TEST(ForestFigure, HoldsSharesInPointsAndOthersInPercentOfTheBaseline) {
  std::vector<ComparedRun> runs;
  for (int seed = 1; seed <= 3; ++seed) {
    const double base = 0.5 + 0.01 * seed;
    runs.push_back(compared("a", seed, base, 200.0));
    runs.push_back(compared("b", seed, base + 0.1 + 0.001 * seed, 200.0 + 50.0 + seed));
  }
  const auto figure = forest_figure(compare(runs, "a", {}), 0);
  ASSERT_TRUE(figure.has_value());
  EXPECT_EQ(figure->name, "forest-smoke");
  ASSERT_EQ(figure->panels.size(), 2U);
  EXPECT_EQ(figure->panels[0].x.label, "difference to A (percentage points)");
  const Series points = series_of(*figure, "B");
  EXPECT_FALSE(points.is_filled);  // three seeds: no test could reject
  EXPECT_NEAR(points.x[0], 10.2, 1e-6);
  EXPECT_NEAR(points.low[0], 10.2 - half_width(0.1), 1e-4);
  EXPECT_NEAR(points.high[0], 10.2 + half_width(0.1), 1e-4);
  const auto& names = figure->panels[1].y.ticks;
  const Series percent = figure->panels[1].series.front();
  const auto row = std::find_if(percent.x.begin(), percent.x.end(),
                                [](double x) { return std::abs(x - 26.0) < 1e-6; }) -
                   percent.x.begin();
  ASSERT_LT(row, std::ssize(percent.x));
  EXPECT_NEAR(percent.high[static_cast<std::size_t>(row)], 26.0 + half_width(0.5), 1e-4);
  for (const AxisTick& name : names) EXPECT_EQ(name.text.find(" (m)"), std::string::npos);
}

/// The axis ends half beyond the largest mean, with room for an arrow; data stay what they are.
TEST(ForestFigure, AWideIntervalDoesNotPressTheOthersTogether) {
  std::vector<ComparedRun> runs;
  for (int seed = 1; seed <= 3; ++seed) {
    runs.push_back(compared("a", seed, 0.5, 200.0));
    runs.push_back(compared("b", seed, 0.5 + 0.001 * seed, 200.0));
    runs.push_back(compared("c", seed, 0.48 + 0.02 * seed, 200.0));
  }
  const auto figure = forest_figure(compare(runs, "a", {}), 0);
  ASSERT_TRUE(figure.has_value());
  EXPECT_NEAR(series_of(*figure, "C").high[0], 2.0 + half_width(2.0), 1e-4);
  EXPECT_GT(figure->panels[0].x.high, 3.0);
  EXPECT_LT(figure->panels[0].x.high, 3.5);
}

}  // namespace
}  // namespace gnbv
