// Laws of the plot of paired differences.
#include "tools/plots/forest_plot.hpp"

#include <algorithm>
#include <cstdio>

#include "tests/tools/plots/plot_support.hpp"

namespace gnbv {
namespace {

ComparedRun compared(const std::string& method, std::uint64_t seed, double coverage,
                     double straight_m) {
  ComparedRun run{.scenario = "smoke", .method = method, .seed = seed, .figures = {}};
  run.figures.coverage_final = {coverage, coverage, coverage};
  run.figures.straight_m = straight_m;
  return run;
}

/// 95 % interval of the mean of three numbers that are so far apart.
double half_width(double apart) { return 4.302652730 * apart / std::sqrt(3.0); }

TEST(Plots, ForestHoldsPairedDifferencesOfSharesInPointsAndOthersInPercentOfTheBaseline) {
  std::vector<ComparedRun> runs;
  for (int seed = 1; seed <= 3; ++seed) {
    const auto key = static_cast<std::uint64_t>(seed);
    const double base = 0.5 + 0.01 * seed;
    runs.push_back(compared("a", key, base, 200.0));
    runs.push_back(compared("b", key, base + 0.1 + 0.001 * seed, 200.0 + 50.0 + seed));
  }
  const auto plot = forest_plot(compare(runs, "a", {}), 0);
  ASSERT_TRUE(plot.has_value());
  EXPECT_EQ(plot->name, "forest-smoke");
  const auto coverage = block(plot->body, "pointsopen1").at(0);
  EXPECT_NEAR(coverage[0], 10.2, 1e-6);
  EXPECT_NEAR(coverage[2], 10.2 - half_width(0.1), 1e-4);
  EXPECT_NEAR(coverage[3], 10.2 + half_width(0.1), 1e-4);
  const auto rows = block(plot->body, "percentopen1");
  const auto is_distance = [](const std::vector<double>& row) {
    return std::abs(row[0] - 26.0) < 1e-6 && std::abs(row[3] - 26.0 - half_width(0.5)) < 1e-4;
  };
  EXPECT_TRUE(std::any_of(rows.begin(), rows.end(), is_distance));
  expect_drawable(*plot);
}

TEST(Plots, ForestCutsTheIntervalsThatWouldPressTheOthersTogether) {
  std::vector<ComparedRun> runs;
  for (int seed = 1; seed <= 3; ++seed) {
    const auto key = static_cast<std::uint64_t>(seed);
    runs.push_back(compared("a", key, 0.5, 200.0));
    runs.push_back(compared("b", key, 0.5 + 0.001 * seed, 200.0));
    runs.push_back(compared("c", key, 0.48 + 0.02 * seed, 200.0));
    runs.push_back(compared("d", key, 0.52 + 0.00443 * (seed - 2), 200.0));
  }
  const auto plot = forest_plot(compare(runs, "a", {}), 0);
  ASSERT_TRUE(plot.has_value());
  const auto wide = block(plot->body, "pointsopen2").at(0);
  EXPECT_GT(wide[3], 3.0) << "a case that needs no cut";
  EXPECT_NEAR(wide[3], wide[0] + half_width(2.0), 1e-4) << "its end is beyond the axis, no cap";
  EXPECT_NEAR(wide[2], wide[0] - half_width(2.0), 1e-4);
  const auto arrows = block(plot->body, "pointsbeyond2");
  EXPECT_GT(arrows.at(0)[2], 0.0);
  // half beyond the largest mean difference, and room for the head, in which the line ends
  double begin = 0.0;
  double end = 0.0;
  const char* const axis = plot->body.c_str() + plot->body.find("set xrange [");
  ASSERT_EQ(std::sscanf(axis, "set xrange [%lf:%lf]", &begin, &end), 2);
  EXPECT_NEAR(end, 3.24, 0.005);
  EXPECT_NEAR(arrows.at(0)[0] + arrows.at(0)[2], end, 1e-9);
  const auto within = block(plot->body, "pointsopen3").at(0);
  EXPECT_GT(within[3], 3.0) << "a case that needs that room";
  EXPECT_LT(within[3], end);
  EXPECT_EQ(plot->body.find("pointsbeyond3"), std::string::npos) << "its cap shows";
  EXPECT_EQ(plot->body.find("pointsbeyond1"), std::string::npos);
  expect_drawable(*plot);
}

}  // namespace
}  // namespace gnbv
