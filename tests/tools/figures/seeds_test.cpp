// Laws of what plots of several runs say of seeds, methods and the paper.
#include <array>
#include <set>

#include "tests/tools/plots/plot_support.hpp"
#include "tools/plots/coverage_plot.hpp"
#include "tools/plots/density_plot.hpp"
#include "tools/plots/script_parts.hpp"
#include "tools/run/run_groups.hpp"

namespace gnbv {
namespace {

bool says(const std::string& body, const std::string& text) {
  return body.find(text) != std::string::npos;
}

std::vector<RunRecord> seeds_of_coverage(std::size_t count) {
  std::vector<RunRecord> runs;
  for (std::size_t i = 0; i < count; ++i) {
    runs.push_back(covered_record(i + 1, {0.83, 0.9, 0.91 + 0.01 * static_cast<double>(i)}));
  }
  return runs;
}

/// An interval of two seeds is six times their distance: they are drawn themselves.
TEST(Plots, FewSeedsAreDrawnThemselvesAndMoreAsAnInterval) {
  for (const std::size_t count : {1U, 2U, 3U}) {
    const std::vector<RunRecord> runs = seeds_of_coverage(count);
    const RunGroup group = group_of(runs);
    const std::string body = coverage_plot({&group, 1}, Effort::views, 0).body;
    EXPECT_EQ(says(body, "with filledcurves"), count == 3) << count;
    EXPECT_EQ(says(body, "$group0seed1 using"), count == 2) << count;
    EXPECT_EQ(says(body, "thin: each of two seeds"), count == 2) << count;
    const std::array<const char*, 3> labels = {"'some (1 seed)'", "'some (2 seeds)'",
                                               "'some (3 seeds), 95 % interval'"};
    EXPECT_TRUE(says(body, labels[count - 1])) << count;
  }
  const std::vector<RunRecord> runs = seeds_of_coverage(2);
  const RunGroup group = group_of(runs);
  const Plot plot = coverage_plot({&group, 1}, Effort::views, 0);
  EXPECT_EQ(block(plot.body, "group0seed1"),
            (std::vector<std::vector<double>>{{0, 83}, {1, 90}, {2, 92}}));
  expect_drawable(plot);
}

/// The same of density, where a seed may end before the others: no interval of two goes on.
TEST(Plots, ADensityHasAnIntervalWhereThreeSeedsReachTheView) {
  const std::vector<MeanSeries> three = {
      mean_series("a", "proposed", {{1, 2}, {2, 3, 9}, {3, 7, 8}})};
  const Plot plot = mean_density_plot(three, "Smoke");
  EXPECT_TRUE(says(plot.body, "'a (3 seeds), 95 % interval'"));
  const auto rows = block(plot.body, "series0");
  EXPECT_EQ(rows[0].size(), 4U);
  EXPECT_EQ(rows[2].size(), 2U);  // then NaN
  expect_drawable(plot);
  const std::vector<MeanSeries> two = {mean_series("a", "proposed", {{1, 2}, {2, 3}})};
  const std::string body = mean_density_plot(two, "Smoke").body;
  EXPECT_TRUE(says(body, "'a (2 seeds)'"));
  EXPECT_FALSE(says(body, "with filledcurves"));
  EXPECT_EQ(block(body, "series0seed1"), (std::vector<std::vector<double>>{{1, 2}, {2, 3}}));
}

/// Curves hide each other: two methods differ in more than their colour.
TEST(Plots, MethodsDifferInDashesAndAllInBoth) {
  std::set<std::pair<std::string_view, std::string_view>> looks;
  for (std::size_t slot = 0; slot < 35; ++slot) {
    looks.emplace(palette_colour(slot), method_dashes(slot));
    EXPECT_NE(method_dashes(slot), method_dashes(slot + 1)) << slot;
  }
  EXPECT_EQ(looks.size(), 35U);
  const std::vector<RunRecord> runs = seeds_of_coverage(1);
  std::vector<RunRecord> others = runs;
  others[0].scenario.planner.utility.name = "isler";
  const std::vector<RunGroup> groups = {group_of(runs), group_of(others)};
  const std::string body = coverage_plot(groups, Effort::views, 0).body;
  for (const std::size_t slot : {0U, 2U}) {
    EXPECT_TRUE(says(
        body, fmt::format("lw 1.3 dt {} lc rgb '{}'", method_dashes(slot), palette_colour(slot))));
  }
}

TEST(Plots, TheAxisOfCoverageBeginsAtTheTensBelow) {
  const auto axis_of = [](const std::vector<double>& coverage) {
    const std::vector<RunRecord> runs = {covered_record(1, coverage)};
    const RunGroup group = group_of(runs);
    const std::string body = coverage_plot({&group, 1}, Effort::views, 0).body;
    const std::size_t at = body.find("set yrange ") + 11;
    return body.substr(at, body.find(']', at) + 1 - at);
  };
  EXPECT_EQ(axis_of({0.83, 0.95}), "[80:100]");
  EXPECT_EQ(axis_of({0.97, 0.99}), "[90:100]");
  EXPECT_EQ(axis_of({0.37, 0.74}), "[30:100]");
  EXPECT_EQ(axis_of({0.17, 0.74}), "[0:100]");  // near 0: from there
  EXPECT_EQ(axis_of({0.05, 0.31}), "[0:40]");   // far below 100
}

RunRecord aircraft_record(const std::string& utility) {
  RunRecord record = covered_record(1, {0.5, 0.8});
  record.scenario = load_scenario("aircraft", {"planner.utility.name=" + utility});
  record.figures->scenario = record.figures->structure = "aircraft";
  record.figures->utility = utility;
  return record;
}

/// Table 2: 94.1 % of Proposed after 635 views, 85.1 % of Isler after 585.
TEST(Plots, ThePapersCoverageIsSaidWithItsValueInGrey) {
  const std::vector<RunRecord> runs = {aircraft_record("proposed"), aircraft_record("isler")};
  std::vector<std::string> notes;
  const std::vector<RunGroup> both = group_runs(runs, notes);
  const std::string alone = coverage_plot({both.data(), 1}, Effort::views, 0).body;
  EXPECT_TRUE(says(alone, "'paper, after its 635 views: 94.1 %'"));
  EXPECT_TRUE(says(alone, "94.1 with lines lw 0.9 dt (6,5) lc rgb '#5c6470'"));
  const Plot plot = coverage_plot(both, Effort::views, 0);
  EXPECT_TRUE(says(plot.body, "'paper''s Proposed, after its 635 views: 94.1 %'"));
  EXPECT_TRUE(says(plot.body, "'paper''s Isler, after its 585 views: 85.1 %'"));
  EXPECT_TRUE(says(plot.body, "'Aircraft'"));
  expect_drawable(plot);
}

TEST(Plots, AKeyDoesNotRepeatTheTitle) {
  EXPECT_EQ(label_below("Smoke", "Smoke, Isler"), "Isler");
  EXPECT_EQ(label_below("Smoke", "Isler"), "Isler");
  EXPECT_EQ(label_below("", "Smoke, Isler"), "Smoke, Isler");
}

TEST(Plots, DensitiesOfSeveralRunsLieOverEachOther) {
  const std::vector<RunRecord> runs = {scored_record(), scored_record()};
  const std::vector<RunGroup> groups = {{.label = "a", .runs = {&runs[0]}},
                                        {.label = "b", .runs = {&runs[1]}}};
  const Plot plot = mean_density_plot(mean_densities(groups), "Smoke");
  const std::string& body = plot.body;
  for (const char* const name : {"series0", "series1"}) {
    const auto rows = block(body, name);
    ASSERT_EQ(rows.size(), runs[0].views.size());
    EXPECT_EQ(rows[3][0], 4.0);  // the first view is 1
    EXPECT_EQ(rows[3][1], runs[0].views[3].density_points_per_voxel);
    EXPECT_EQ(block(body, name == std::string("series0") ? "end0" : "end1").at(0), rows.back());
  }
  EXPECT_NE(body.find("set xlabel 'views'"), std::string::npos);
  EXPECT_NE(body.find("'Smoke'"), std::string::npos);
  expect_drawable(plot);
}

}  // namespace
}  // namespace gnbv
