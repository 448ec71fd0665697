// Laws of the plots of one run: their data are its own figures.
#include "tools/plots/run_plots.hpp"

#include <algorithm>
#include <functional>
#include <map>

#include "tests/tools/plots/plot_support.hpp"
#include "tools/plots/coverage_plot.hpp"
#include "tools/plots/script_parts.hpp"

namespace gnbv {
namespace {

/// Where a plot of all runs has the densities, that of each has entropy alone.
TEST(RunPlots, DensityIsDrawnOnce) {
  const RunRecord record = scored_record();
  const Plot both = *density_entropy_plot(record);
  const Plot entropy = *density_entropy_plot(record, false);
  EXPECT_EQ(both.name, "density");
  EXPECT_EQ(entropy.name, "entropy");
  EXPECT_NE(both.body.find("density (points"), std::string::npos);
  EXPECT_EQ(entropy.body.find("density (points"), std::string::npos);
  EXPECT_NE(entropy.body.find("'views'"), std::string::npos);  // its axis is the last one
}

/// As on the axis of coverage: what was known after the first view stands at 1.
TEST(Plots, DensityAndEntropyAreTheRunsFigures) {
  const RunRecord record = scored_record();
  const auto rows = block(density_entropy_plot(record)->body, "views");
  ASSERT_EQ(rows.size(), record.views.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i], (std::vector<double>{static_cast<double>(i + 1), record.views[i].entropy_nat,
                                            record.views[i].density_points_per_voxel}));
  }
}

TEST(Plots, FrontierPhasesAreTheRowsOfTheirSampler) {
  const RunRecord record = scored_record();
  const std::vector<Phase> phases = frontier_phases(record.views);
  ASSERT_EQ(phases.size(), 2U);
  EXPECT_EQ(phases[0].first, 4);
  EXPECT_EQ(phases[0].last, 6);
  EXPECT_EQ(phases[1].first, 11);
  EXPECT_EQ(phases[1].last, 11);
  const std::string body = density_entropy_plot(record)->body;
  EXPECT_NE(body.find("rectangle from 4.5,graph 0 to 7.5,graph 1"), std::string::npos);
  EXPECT_NE(body.find("rectangle from 11.5,graph 0 to 12.5,graph 1"), std::string::npos);
}

/// The factors that are drawn multiply to the utility, and the start, which nobody scored, is out.
TEST(Plots, TermsMultiplyToTheUtility) {
  const auto rows = block(terms_plot(scored_record())->body, "raw");
  ASSERT_EQ(rows.size(), 11U);
  for (const auto& row : rows) {
    EXPECT_NEAR(row[1], (row[2] + row[3]) * row[4] * row[5] * row[6], 1e-9);
    EXPECT_NEAR(row[6], std::log10(49.0 + row[0]), 1e-9);
    EXPECT_NEAR(row[2], 0.4, 1e-12);
    EXPECT_NEAR(row[3], 0.15, 1e-12);
  }
  RunRecord unscored = made_record();
  EXPECT_FALSE(terms_plot(unscored).has_value());
}

/// A view may be chosen for want of a better one: its value of 0 is drawn, not bridged.
TEST(Plots, TermsOfWorthlessViewsAreDrawn) {
  RunRecord record = scored_record();
  Score& worthless = record.views[5].decision.score;
  worthless = {.information = 0.02, .distance = 0.9};  // sees nothing occupied
  const auto plot = terms_plot(record);
  ASSERT_TRUE(plot.has_value());
  const auto rows = block(plot->body, "raw");
  ASSERT_EQ(rows.size(), 11U);
  EXPECT_EQ(rows[4][0], 6.0);
  EXPECT_EQ(rows[4][1], 0.0);
  EXPECT_EQ(rows[4][2], 0.0);
  expect_drawable(*plot);
}

/// Panels lie from top to bottom in the order in which they are said, of any utility.
TEST(Plots, PanelsFollowEachOtherDownwards) {
  RunRecord discounted = scored_record();
  discounted.scenario.planner.utility.name = "bircher";
  for (ViewRecord& view : discounted.views) view.decision.score.value *= 1e5;
  for (const RunRecord& record : {scored_record(), discounted}) {
    std::istringstream lines(terms_plot(record)->body);
    std::vector<double> tops;
    for (std::string line; std::getline(lines, line);) {
      const std::size_t at = line.find("set tmargin at screen ");
      if (at != std::string::npos) tops.push_back(std::stod(line.substr(at + 22)));
    }
    ASSERT_EQ(tops.size(), 3U);
    EXPECT_GT(tops[0], tops[1]);
    EXPECT_GT(tops[1], tops[2]);
  }
}

TEST(Plots, LongNumbersAreSaidInThousands) {
  EXPECT_NE(y_axis(0.0, 183'000.0).find("set format y '%.0s%c'"), std::string::npos);
  EXPECT_NE(y_axis(0.0, 1'830'000.0).find("set format y '%.1s%c'"), std::string::npos);
  EXPECT_NE(y_axis(0.0, 9000.0).find("set format y '% .0f'"), std::string::npos);
  EXPECT_NE(y_axis(123'456.0, 123'460.0).find("set format y '% .0f'"), std::string::npos);
}

/// No 94 beside 93.9.
TEST(Plots, AllMarksOfAnAxisHaveAsManyDecimals) {
  EXPECT_NE(y_axis(93.7, 94.1).find("set format y '% .1f'"), std::string::npos);
  EXPECT_NE(y_axis(0.0, 0.05).find("set format y '% .2f'"), std::string::npos);
  EXPECT_NE(y_axis(-30.0, 50.0).find("set format y '% .0f'"), std::string::npos);
  EXPECT_NE(y_axis(0.0, 1.2e-8).find("set format y '% h'"), std::string::npos);
}

TEST(Plots, ATightAxisEndsWhereItsValuesDo) {
  EXPECT_NE(tight_y_axis(-21.0, 25.0, 3).find("set yrange [-22.84:26.84]\nset ytics 20\n"),
            std::string::npos)
      << tight_y_axis(-21.0, 25.0, 3);
  EXPECT_NE(tight_y_axis(0.0, 40.0, 3).find("set yrange [0:40]"), std::string::npos);
  // of -50, 0, 50 the values leave one mark
  EXPECT_NE(tight_y_axis(-30.0, 34.0, 3).find("set ytics 20\n"), std::string::npos)
      << tight_y_axis(-30.0, 34.0, 3);
}

TEST(Plots, PanelsShareAnAxisThatSeparatesThousands) {
  Panels panels(2, "title", "mission time (s)", {900.0, 2100.0});
  const std::string first = panels.next("above");
  EXPECT_NE(first.find("set xrange [900:2100]"), std::string::npos);
  EXPECT_EQ(first.find("1,000"), std::string::npos);
  EXPECT_NE(panels.next("below").find("'1,000' 1000"), std::string::npos);
}

TEST(Plots, MovingMeansShrinkAtTheEnds) {
  const std::vector<double> values = {1, 2, 4, 8, 16};
  EXPECT_EQ(moving_mean(values, 3), (std::vector<double>{1, 7.0 / 3, 14.0 / 3, 28.0 / 3, 16}));
  EXPECT_EQ(moving_mean(values, 1), values);
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> with_gaps = moving_mean(std::vector{unknown, 4.0, unknown, 2.0}, 3);
  EXPECT_TRUE(std::isnan(with_gaps[0]));  // alone in its window
  EXPECT_EQ(with_gaps[1], 4.0);
  EXPECT_EQ(with_gaps[2], 3.0);
}

TEST(Plots, TermsNameNoPredictionWhereThereIsNone) {
  RunRecord record = scored_record();
  EXPECT_NE(terms_plot(record)->body.find("γ prediction"), std::string::npos);
  for (ViewRecord& view : record.views) view.decision.score.prediction = 2e-4;
  const std::string little = terms_plot(record)->body;  // too low to be seen: said, not drawn
  EXPECT_EQ(little.find("'γ prediction'"), std::string::npos);
  EXPECT_NE(little.find("γ prediction up to 0.0001"), std::string::npos);
  for (ViewRecord& view : record.views) view.decision.score.prediction = 0.0;
  EXPECT_EQ(terms_plot(record)->body.find("γ prediction"), std::string::npos);
}

TEST(Plots, TheKeyOfTermsStandsInThePicture) {
  const std::string body = terms_plot(scored_record())->body;
  std::map<std::string, std::vector<double>> rows;  // where marks and words begin, by their height
  std::istringstream lines(body);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find(" at screen ");
    if (!line.starts_with("set label 1") || at == std::string::npos) continue;  // 10 to 19
    std::istringstream place(line.substr(at + 11));
    double x = 0.0;
    std::string y;
    if (place >> x && place.get() == ',' && place >> y) rows[y].push_back(x);
  }
  ASSERT_GE(rows.size(), 3U);  // phases, terms of the sum, factors
  for (const auto& [y, begins] : rows) {
    EXPECT_EQ(std::adjacent_find(begins.begin(), begins.end(), std::greater_equal<>()),
              begins.end())
        << y;
    EXPECT_GT(begins.front(), 0.0);
    EXPECT_LT(begins.back(), 0.95);
  }
}

/// The axis holds the values, and two marks at least, however close to each other these are.
TEST(Plots, AxesHoldWhatIsDrawn) {
  const std::vector<std::pair<double, double>> ranges = {
      {0.0, 0.0}, {7.0, 7.0}, {-3e6, -3e6}, {1e-12, 1e-12}, {123456.7, 123456.9}, {0.2, 1.4}};
  for (const auto& [low, high] : ranges) {
    double bottom = 0.0;
    double top = 0.0;
    double step = 0.0;
    const std::string axis = y_axis(low, high);
    ASSERT_EQ(
        std::sscanf(axis.c_str(), "set yrange [%lf:%lf]\nset ytics %lf", &bottom, &top, &step), 3);
    EXPECT_LE(bottom, low);
    EXPECT_GE(top, high);
    EXPECT_GE(top - bottom, 1.999 * step) << axis;
    EXPECT_LE(top - bottom, 8.0 * step) << axis;
  }
}

TEST(Plots, OneViewIsEnough) {
  RunRecord record = scored_record();
  record.views = {record.views[1]};
  record.views[0].density_points_per_voxel = 0.0;
  for (const auto& plot : {density_entropy_plot(record), terms_plot(record)}) {
    ASSERT_TRUE(plot.has_value());
    expect_drawable(*plot);
  }
  const std::vector<RunRecord> runs = {covered_record(1, {0.2})};
  for (const Effort effort : {Effort::views, Effort::metres, Effort::seconds}) {
    const RunGroup group = group_of(runs);
    expect_drawable(coverage_plot({&group, 1}, effort, 0));
  }
}

}  // namespace
}  // namespace gnbv
