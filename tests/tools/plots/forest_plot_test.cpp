// Laws of the plot of paired differences.
#include "tools/plots/forest_plot.hpp"

#include "tests/tools/plots/plot_support.hpp"

namespace gnbv {
namespace {

ComparedRun compared(const std::string& method, std::uint64_t seed, double coverage) {
  ComparedRun run{.scenario = "smoke", .method = method, .seed = seed, .figures = {}};
  run.figures.coverage_final = {coverage, coverage, coverage};
  return run;
}

TEST(Plots, ForestHoldsThePairedDifferencesInPercentOfTheBaseline) {
  std::vector<ComparedRun> runs;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const double base = 0.5 + 0.01 * static_cast<double>(seed);
    runs.push_back(compared("a", seed, base));
    runs.push_back(compared("b", seed, base + 0.1 + 0.001 * static_cast<double>(seed)));
  }
  const auto plot = forest_plot(compare(runs, "a", {}), 0);
  ASSERT_TRUE(plot.has_value());
  EXPECT_EQ(plot->name, "forest-smoke");
  const auto rows = block(plot->body, "open1");
  ASSERT_FALSE(rows.empty());
  EXPECT_NEAR(rows[0][0], 100.0 * 0.102 / 0.52, 1e-6);
  EXPECT_NEAR(rows[0][2], 100.0 * 4.302652730 * 0.001 / std::sqrt(3.0) / 0.52, 1e-4);
  expect_drawable(*plot);
}

}  // namespace
}  // namespace gnbv
