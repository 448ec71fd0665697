// Laws of the plots of several runs: coverage, density, and how many got how far; intervals are
// Student's.
#include "tools/plots/coverage_plot.hpp"

#include "tests/tools/plots/plot_support.hpp"
#include "tools/plots/reach_plot.hpp"
#include "tools/plots/script_parts.hpp"

namespace gnbv {
namespace {

/// t(0.975, 4) = 2.776445; the deviation of 0.5 +- {0, 1, 2} / 10 is sqrt(0.1 / 4).
TEST(Plots, BandsAreStudentsIntervals) {
  std::vector<RunRecord> runs;
  for (int i = 0; i < 5; ++i) {
    runs.push_back(covered_record(static_cast<std::uint64_t>(i + 1), {0.2, 0.3 + 0.1 * i}));
  }
  const RunGroup group = group_of(runs);
  const auto rows = block(coverage_plot({&group, 1}, Effort::views, 0).body, "group0");
  ASSERT_EQ(rows.size(), 2U);
  const double half = 100.0 * 2.776445105 * std::sqrt(0.025) / std::sqrt(5.0);
  EXPECT_NEAR(rows[0][3] - rows[0][1], 0.0, 1e-9);
  EXPECT_NEAR(rows[1][1], 50.0, 1e-9);
  EXPECT_NEAR(rows[1][2], 50.0 - half, 1e-6);
  EXPECT_NEAR(rows[1][3], 50.0 + half, 1e-6);
}

TEST(Plots, OneRunsCurveIsItsOwnAndAnEndedRunKeepsItsCoverage) {
  const std::vector<RunRecord> runs = {covered_record(1, {0.2, 0.4, 0.5}),
                                       covered_record(2, {0.2, 0.8})};
  RunGroup alone{.label = "a", .runs = {&runs[0]}};
  const auto own = block(coverage_plot({&alone, 1}, Effort::metres, 0).body, "group0");
  EXPECT_EQ(own,
            (std::vector<std::vector<double>>{{0, 20, 20, 20}, {2, 40, 40, 40}, {4, 50, 50, 50}}));
  const RunGroup both = group_of(runs);
  EXPECT_NEAR(mean_coverage(both, Effort::views, 0)[2].coverage.mean, 0.65, 1e-12);
  const auto metres = mean_coverage(both, Effort::metres, 0);
  ASSERT_EQ(metres.size(), 201U);
  EXPECT_NEAR(metres[25].coverage.mean, 0.5 * (0.25 + 0.35), 1e-12);  // at 0.5 m of 4
}

/// Views that turn in place take no metres: what they cover begins the curve, as no stub.
TEST(Plots, ViewsFromTheFirstPlaceLeaveNoStub) {
  std::vector<RunRecord> runs = {covered_record(1, {0.2, 0.4, 0.6, 0.7})};
  runs[0].figures->curve.metres = {0.0, 0.0, 0.0, 7.0};
  const RunGroup group = group_of(runs);
  const auto rows = block(coverage_plot({&group, 1}, Effort::metres, 0).body, "group0");
  EXPECT_EQ(rows, (std::vector<std::vector<double>>{{0, 60, 60, 60}, {7, 70, 70, 70}}));
  EXPECT_EQ(block(coverage_plot({&group, 1}, Effort::views, 0).body, "group0").size(), 4U);
}

TEST(Plots, CoverageMarksEndsAndTheCeiling) {
  std::vector<RunRecord> runs = {covered_record(1, {0.2, 0.4, 0.5})};
  const RunGroup group = group_of(runs);
  const std::string without = coverage_plot({&group, 1}, Effort::metres, 0).body;
  EXPECT_EQ(block(without, "end0"), (std::vector<std::vector<double>>{{4, 50}}));
  EXPECT_EQ(without.find("'ceiling'"), std::string::npos);
  EXPECT_NE(without.find("'Smoke'"), std::string::npos);
  runs[0].figures->ceiling = 0.975;
  const std::string with = coverage_plot({&group, 1}, Effort::metres, 0).body;
  EXPECT_NE(with.find("97.5 with lines"), std::string::npos);
  EXPECT_NE(with.find("'ceiling'"), std::string::npos);
  const auto end = coverage_end_plot({&group, 1}, Effort::metres, 0);
  ASSERT_TRUE(end.has_value());
  EXPECT_NE(end->body.find("set xrange [3.4:4.04]"), std::string::npos);
  EXPECT_NE(end->body.find("set xlabel 'last 15 % of the path, straight legs (m)'"),
            std::string::npos);
  expect_drawable(*end);
}

/// A table says what seeds took as a mean: the mark stands there, not where the longest ends.
TEST(Plots, TheMarkOfSeveralRunsIsOnTheirMeanCurveAtTheirMeanLength) {
  const std::vector<RunRecord> runs = {covered_record(1, {0.2, 0.4, 0.5}),
                                       covered_record(2, {0.2, 0.8})};
  const RunGroup group = group_of(runs);
  const Plot plot = coverage_plot({&group, 1}, Effort::metres, 0);
  EXPECT_EQ(block(plot.body, "end0"), (std::vector<std::vector<double>>{{3, 62.5}}));
  EXPECT_NE(plot.body.find("'mean end of the seeds'"), std::string::npos);
  expect_drawable(plot);
  const RunGroup alone{.label = "a", .runs = {&runs[0]}};
  EXPECT_EQ(coverage_plot({&alone, 1}, Effort::metres, 0).body.find("mean end"), std::string::npos);
  // 4 m and 4.03 m: the mark is where both end, which needs no word
  std::vector<RunRecord> alike = {covered_record(1, {0.2, 0.4, 0.5}),
                                  covered_record(2, {0.2, 0.4, 0.8})};
  alike[1].figures->curve.metres.back() = 4.03;
  const RunGroup both = group_of(alike);
  EXPECT_EQ(coverage_plot({&both, 1}, Effort::metres, 0).body.find("mean end"), std::string::npos);
}

/// The end's axis goes around its curve: a key names no line beyond it.
TEST(Plots, TheEndsKeyNamesTheCeilingWhereItIsOnTheAxis) {
  std::vector<RunRecord> runs = {covered_record(1, {0.2, 0.4, 0.5})};
  const RunGroup group = group_of(runs);
  for (const auto& [ceiling, is_named] : {std::pair{0.975, false}, std::pair{0.5, true}}) {
    runs[0].figures->ceiling = ceiling;
    const auto end = coverage_end_plot({&group, 1}, Effort::metres, 0);
    ASSERT_TRUE(end.has_value());
    EXPECT_EQ(end->body.find("'ceiling'") != std::string::npos, is_named) << ceiling;
    EXPECT_EQ(end->body.find(" with lines lw 0.9") != std::string::npos, is_named) << ceiling;
  }
}

/// A curve that hardly rises does not look steep, and an axis that begins above 0 says so.
TEST(Plots, CoverageAxesSayThatTheyAreCutAndShowAPercentAtLeast) {
  const auto range_of = [](const Plot& plot) {
    std::array<double, 2> range{};
    const std::size_t at = plot.body.find("set yrange [");
    EXPECT_EQ(std::sscanf(plot.body.c_str() + at, "set yrange [%lf:%lf]", &range[0], &range[1]), 2);
    return range;
  };
  for (const auto& [first, is_cut] : {std::pair{0.12, false}, std::pair{0.45, true}}) {
    const std::vector<RunRecord> runs = {covered_record(1, {first, 0.8, 0.8005})};
    const RunGroup group = group_of(runs);
    const Plot whole = coverage_plot({&group, 1}, Effort::views, 0);
    EXPECT_EQ(range_of(whole)[0], is_cut ? 40.0 : 0.0);
    EXPECT_EQ(whole.body.find("axis cut") != std::string::npos, is_cut);
    EXPECT_NE(whole.body.find("'views (0: the profile alone)'"), std::string::npos);
    const auto end = coverage_end_plot({&group, 1}, Effort::views, 0);
    ASSERT_TRUE(end.has_value());
    EXPECT_GE(range_of(*end)[1] - range_of(*end)[0], 1.0);
    EXPECT_NE(end->body.find("axis cut"), std::string::npos);
  }
}

/// The way from the profile to the first view is in no distance, and in no time either.
TEST(Plots, TimeAndDistanceBothBeginWithTheFirstView) {
  std::vector<RunRecord> runs = {covered_record(1, {0.2, 0.4, 1.0})};
  runs[0].figures->curve.metres = {0.0, 0.0, 7.0};
  runs[0].figures->curve.seconds = {0.0, 60.0, 75.0};
  runs[0].figures->ceiling = 1.0;
  const RunGroup group = group_of(runs);
  for (const auto& [effort, end] : {std::pair{Effort::metres, 7.0}, {Effort::seconds, 15.0}}) {
    const auto rows = block(coverage_plot({&group, 1}, effort, 0).body, "group0");
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(rows[0][0], 0.0);
    EXPECT_EQ(rows[1][0], end);
    EXPECT_EQ(block(reach_plot({&group, 1}, effort, 0.9)->body, "reach0")[1][0], end);
    EXPECT_NE(effort_label(effort).find("since the first view"), std::string_view::npos);
  }
}

TEST(Plots, RunsWithoutViewsHaveACoverage) {
  const std::vector<RunRecord> runs = {covered_record(1, {0.2}), covered_record(2, {0.4})};
  for (const Effort effort : {Effort::views, Effort::metres, Effort::seconds}) {
    for (const CoveragePoint& point : mean_coverage(group_of(runs), effort, 0)) {
      EXPECT_EQ(point.effort, 0.0);
      EXPECT_NEAR(point.coverage.mean, 0.3, 1e-12);
    }
  }
}

TEST(ReachPlot, StepsUpWhereEachRunGetsThereAndStaysBelowForThoseThatDoNot) {
  std::vector<RunRecord> runs = {covered_record(1, {0.1, 0.5, 0.96}),
                                 covered_record(2, {0.1, 0.96, 0.97, 1.0}),
                                 covered_record(3, {0.1, 0.9}), covered_record(4, {0.96, 1.0})};
  for (const std::size_t i : {0, 1, 2}) runs[i].figures->ceiling = 1.0;  // not of the last
  const RunGroup group = group_of(runs);
  const auto plot = reach_plot({&group, 1}, Effort::metres, 0.95);
  ASSERT_TRUE(plot.has_value());
  EXPECT_EQ(plot->name, "reach-metres");
  // 2 m a view: seed 2 after one view, seed 1 after two, seed 3 never; the longest has three views
  EXPECT_NE(plot->body.find(fmt::format("$reach0 << EOD\n0 0\n2 {}\n4 {}\n6 {}\nEOD\n", 100.0 / 3.0,
                                        200.0 / 3.0, 200.0 / 3.0)),
            std::string::npos)
      << plot->body;
  EXPECT_NE(plot->body.find("(2 of 3)"), std::string::npos);
  for (RunRecord& run : runs) run.figures->ceiling.reset();
  EXPECT_FALSE(reach_plot({&group, 1}, Effort::metres, 0.95));
  expect_drawable(*plot);
}

}  // namespace
}  // namespace gnbv
