// Laws of the figures of several runs: coverage, density, how many got how far, differences.
#include "tools/figures/group_figures.hpp"

#include <gmock/gmock.h>

#include <span>

#include "tests/tools/figures/figure_support.hpp"

namespace gnbv {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using Values = std::vector<double>;

/// 95 % interval of the mean of three numbers that are so far apart.
double half_width(double apart) { return 4.302652730 * apart / std::sqrt(3.0); }

std::vector<RunRecord> seeds_of_coverage(std::size_t count) {
  std::vector<RunRecord> runs;
  for (std::size_t i = 0; i < count; ++i) {
    runs.push_back(covered_record(i + 1, {0.83, 0.9, 0.91 + 0.01 * static_cast<double>(i)}));
  }
  return runs;
}

Figure coverage_of(const std::vector<RunRecord>& runs, Effort effort = Effort::metres,
                   double size_m = 0.05) {
  const RunGroup group = group_of(runs);
  return coverage_figure({&group, 1}, effort, size_m);
}

/// An interval of two seeds is six times their distance: they are drawn themselves.
TEST(GroupFigures, FewSeedsAreDrawnThemselvesAndMoreAsAnInterval) {
  const std::array<const char*, 3> labels = {"some (1 seed)", "some (2 seeds)",
                                             "some (3 seeds), 95 % interval"};
  for (const std::size_t count : {1U, 2U, 3U}) {
    const Figure figure = coverage_of(seeds_of_coverage(count), Effort::views);
    const Series mean = series_of(figure, "some");
    EXPECT_EQ(mean.mark, Mark::steps);
    EXPECT_EQ(mean.low.empty(), count < 3) << count;
    const double half = count == 3 ? half_width(1.0) : 0.0;
    EXPECT_NEAR(mean.high.empty() ? 0.0 : mean.high[2] - mean.y[2], half, 1e-6);
    EXPECT_EQ(series_of(figure, "some, run 2").y.empty(), count != 2) << count;
    EXPECT_EQ(has_note(figure, "thin: each of two seeds"), count == 2) << count;
    EXPECT_THAT(labels_in(figure), Contains(labels[count - 1]));
  }
  EXPECT_EQ(series_of(coverage_of(seeds_of_coverage(2), Effort::views), "some, run 2").y,
            (Values{83, 90, 92}));
}

/// A table says what seeds took as a mean: the mark stands there, not where the longest ends.
TEST(GroupFigures, TheMarkIsOnTheMeanCurveAtTheMeanLength) {
  std::vector<RunRecord> runs = {covered_record(1, {0.2, 0.4, 0.5}), covered_record(2, {0.2, 0.8})};
  const Figure figure = coverage_of(runs);
  EXPECT_THAT(*series_of(figure, "some").end, ElementsAre(3.0, testing::DoubleNear(60.0, 1e-9)));
  EXPECT_TRUE(has_note(figure, "mean end of the seeds"));
  EXPECT_EQ(series_of(figure, "some").x.back(), 4.0);  // the line goes on to the longest
  // 4 m and 4.03 m: the mark is where both end, which needs no word
  runs[1] = covered_record(2, {0.2, 0.4, 0.8});
  runs[1].figures->curve.metres.back() = 4.03;
  EXPECT_FALSE(has_note(coverage_of(runs), "mean end"));
}

/// A ceiling is known at 0.05 m: at other sizes there is no line, least of all one at 0 %.
TEST(GroupFigures, ACeilingIsDrawnAtTheSizeWhereItIsKnown) {
  std::vector<RunRecord> runs = {covered_record(1, {0.2, 0.4, 0.5})};
  EXPECT_TRUE(series_of(coverage_of(runs), "ceiling").y.empty());
  runs[0].figures->ceiling = 0.975;
  EXPECT_EQ(series_of(coverage_of(runs), "ceiling").y, Values{97.5});
  for (const double size_m : {0.1, 0.5}) {
    EXPECT_TRUE(series_of(coverage_of(runs, Effort::metres, size_m), "ceiling").y.empty());
  }
  const RunGroup group = group_of(runs);
  for (const auto& [ceiling, is_named] : {std::pair{0.975, false}, std::pair{0.5, true}}) {
    runs[0].figures->ceiling = ceiling;
    const auto end = coverage_end_figure({&group, 1}, Effort::metres, 0.05);
    ASSERT_TRUE(end.has_value());
    EXPECT_EQ(!series_of(*end, "ceiling").y.empty(), is_named) << "a riddle beyond the axis";
  }
}

TEST(GroupFigures, TheEndNamesThoseThatEndedBefore) {
  const std::vector<RunRecord> longer = {covered_record(1, {0.2, 0.4, 0.5, 0.6, 0.7})};
  const std::vector<RunRecord> shorter = {covered_record(1, {0.2, 0.85})};
  std::vector<RunGroup> groups = {group_of(longer), group_of(shorter)};
  groups[1].label = "Isler";
  const auto end = coverage_end_figure(groups, Effort::metres, 0.05);
  ASSERT_TRUE(end.has_value());
  EXPECT_NEAR(end->panels[0].x.low, 6.8, 1e-9);  // the last 15 % of 8 m
  EXPECT_FALSE(series_of(*end, "some").x.empty());
  EXPECT_TRUE(series_of(*end, "Isler").x.empty());
  EXPECT_TRUE(has_note(*end, "Isler ended before: 85.0 % at 2 m"));
  EXPECT_EQ(end->panels[0].x.label, "last 15 % of the path, straight legs (m)");
}

/// A curve that hardly rises does not look steep, and an axis that begins above 0 says so.
TEST(GroupFigures, CoverageAxesSayThatTheyAreCutAndShowAPercentAtLeast) {
  using Case = std::tuple<Values, double, double>;
  for (const auto& [coverage, low, high] :
       {Case{{0.83, 0.95}, 80, 100}, Case{{0.97, 0.99}, 90, 100}, Case{{0.37, 0.74}, 30, 100},
        Case{{0.17, 0.74}, 0, 100},    // near 0: from there
        Case{{0.05, 0.31}, 0, 40}}) {  // far below 100
    const Axis y = coverage_of({covered_record(1, coverage)}, Effort::views).panels[0].y;
    EXPECT_EQ(y.low, low);
    EXPECT_EQ(y.high, high);
    EXPECT_EQ(y.label.find("axis cut") != std::string::npos, low > 0.0);
  }
  const std::vector<RunRecord> flat = {covered_record(1, {0.45, 0.8, 0.8005})};
  const RunGroup group = group_of(flat);
  const auto end = coverage_end_figure({&group, 1}, Effort::views, 0.05);
  EXPECT_GE(end->panels[0].y.high - end->panels[0].y.low, 1.0);
}

RunRecord aircraft_record(const std::string& utility) {
  RunRecord record = covered_record(1, {0.5, 0.8});
  record.scenario = load_scenario("aircraft", {"planner.utility.name=" + utility});
  record.figures->scenario = record.figures->structure = "aircraft";
  record.figures->utility = utility;
  return record;
}

/// Table 2: 94.1 % of Proposed after 635 views, 85.1 % of Isler after 585.
TEST(GroupFigures, ThePapersCoverageIsSaidWithItsValue) {
  const std::vector<RunRecord> runs = {aircraft_record("proposed"), aircraft_record("isler")};
  std::vector<std::string> notes;
  const std::vector<RunGroup> both = group_runs(runs, notes);
  const Figure alone = coverage_figure({both.data(), 1}, Effort::views, 0.05);
  EXPECT_THAT(labels_in(alone), Contains("paper, after its 635 views: 94.1 %"));
  EXPECT_NEAR(series_of(alone, "paper").y[0], 94.1, 1e-9);
  const Figure figure = coverage_figure(both, Effort::views, 0.05);
  EXPECT_THAT(labels_in(figure), Contains("paper's Proposed, after its 635 views: 94.1 %"));
  EXPECT_THAT(labels_in(figure), Contains("paper's Isler, after its 585 views: 85.1 %"));
  EXPECT_NE(series_of(figure, "paper's Isler").look.dashes,
            series_of(figure, "paper's Proposed").look.dashes);
  EXPECT_EQ(figure.title, "Aircraft");  // which no label repeats
  EXPECT_THAT(labels_in(figure), Contains("Isler (1 seed)"));
}

TEST(GroupFigures, RunsWithoutViewsHaveACoverage) {
  for (const Effort effort : std::span(kEfforts).first(5)) {  // energy is not known of them
    const Figure figure = coverage_of({covered_record(1, {0.2}), covered_record(2, {0.4})}, effort);
    EXPECT_EQ(series_of(figure, "some").x, Values{0.0});
    EXPECT_NEAR(series_of(figure, "some").y[0], 30.0, 1e-9);
    EXPECT_GT(figure.panels[0].x.high, 0.0);
  }
}

TEST(GroupFigures, ReachStepsUpWhereEachRunGetsThereAndStaysBelowForThoseThatDoNot) {
  std::vector<RunRecord> runs = {covered_record(1, {0.1, 0.5, 0.96}),
                                 covered_record(2, {0.1, 0.96, 0.97, 1.0}),
                                 covered_record(3, {0.1, 0.9}), covered_record(4, {0.96, 1.0})};
  for (const std::size_t i : {0, 1, 2}) runs[i].figures->ceiling = 1.0;  // not of the last
  const RunGroup group = group_of(runs);
  const auto figure = reach_figure({&group, 1}, Effort::metres, 0.95);
  ASSERT_TRUE(figure.has_value());
  EXPECT_EQ(figure->name, "reach-metres");
  // 2 m a view: seed 2 after one view, seed 1 after two, seed 3 never; the longest has three views
  const Series steps = series_of(*figure, "some");
  EXPECT_EQ(steps.x, (Values{0, 2, 4, 6}));
  EXPECT_EQ(steps.y, (Values{0, 100.0 / 3.0, 200.0 / 3.0, 200.0 / 3.0}));
  EXPECT_THAT(labels_in(*figure), ElementsAre("some (2 of 3)"));
  for (RunRecord& run : runs) run.figures->ceiling.reset();
  EXPECT_FALSE(reach_figure({&group, 1}, Effort::metres, 0.95));
}

/// As of coverage: what a mission had at its end it keeps where others go on.
TEST(GroupFigures, ADensityIsTheMeanOfAllSeedsAlsoPastTheEndOfSome) {
  const auto three = density_group("a", {}, {{1, 2}, {}, {2, 3, 9}, {3, 7, 8}});
  const Figure figure = mean_density_figure({&*three, 1}, "Smoke");
  EXPECT_EQ(series_of(figure, "a").x, (Values{1, 2, 3}));  // the first view is 1
  EXPECT_NEAR(series_of(figure, "a").y[2], (2.0 + 9.0 + 8.0) / 3.0, 1e-12);
  EXPECT_FALSE(density_group("a", {}, {{}}));
  EXPECT_THAT(labels_in(figure), ElementsAre("a (3 seeds), 95 % interval"));
  const std::vector<RunRecord> runs = {scored_record(), scored_record()};
  const std::vector<RunGroup> groups = {{.label = "a", .runs = {&runs[0]}},
                                        {.label = "b", .runs = {&runs[1]}}};
  const auto both = density_figure(groups);
  for (const char* const name : {"a", "b"}) {
    const Series series = series_of(*both, name);
    ASSERT_EQ(series.y.size(), runs[0].views.size());
    EXPECT_EQ(series.y[3], runs[0].views[3].density_points_per_voxel);
  }
}

MissionRow compared(const std::string& method, int seed, double coverage, double straight_m) {
  RunFigures figures;
  figures.scenario = "smoke";
  figures.utility = method;
  figures.seed = static_cast<std::uint64_t>(seed);
  figures.coverage_final = {coverage, coverage, coverage};
  figures.straight_m = straight_m;
  return mission_row(figures);
}

TEST(ForestFigure, HoldsSharesInPointsAndOthersInPercentOfTheBaseline) {
  std::vector<MissionRow> runs;
  for (int seed = 1; seed <= 3; ++seed) {
    const double base = 0.5 + 0.01 * seed;
    runs.push_back(compared("a", seed, base, 200.0));
    runs.push_back(compared("b", seed, base + 0.1 + 0.001 * seed, 200.0 + 50.0 + seed));
  }
  const auto figure = forest_figure(compare(runs, "a"), 0);
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
  std::vector<MissionRow> runs;
  for (int seed = 1; seed <= 3; ++seed) {
    runs.push_back(compared("a", seed, 0.5, 200.0));
    runs.push_back(compared("b", seed, 0.5 + 0.001 * seed, 200.0));
    runs.push_back(compared("c", seed, 0.48 + 0.02 * seed, 200.0));
  }
  const auto figure = forest_figure(compare(runs, "a"), 0);
  ASSERT_TRUE(figure.has_value());
  EXPECT_NEAR(series_of(*figure, "C").high[0], 2.0 + half_width(2.0), 1e-4);
  EXPECT_GT(figure->panels[0].x.high, 3.0);
  EXPECT_LT(figure->panels[0].x.high, 3.5);
}

}  // namespace
}  // namespace gnbv
