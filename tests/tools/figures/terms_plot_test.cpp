// Laws of the plot of a utility's terms: its data are the views' own, and it says what they are.
#include "tools/plots/terms_plot.hpp"

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <limits>
#include <map>
#include <sstream>

#include "tests/tools/plots/plot_support.hpp"

namespace gnbv {
namespace {

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
  const std::vector<RunRecord> records = {scored_record(), discounted};
  for (const RunRecord& record : records) {
    std::istringstream lines(terms_plot(record)->body);
    std::vector<double> tops;
    for (std::string line; std::getline(lines, line);) {
      const std::size_t at = line.find("set tmargin at screen ");
      if (at != std::string::npos) tops.push_back(std::stod(line.substr(at + 22)));
    }
    ASSERT_EQ(tops.size(), &record == &records.front() ? 5U : 3U);
    EXPECT_TRUE(std::is_sorted(tops.rbegin(), tops.rend()));
  }
}

TEST(Plots, TermsNameNoPredictionWhereThereIsNone) {
  RunRecord record = scored_record();
  EXPECT_NE(terms_plot(record)->body.find("'P, prediction'"), std::string::npos);
  for (ViewRecord& view : record.views) view.decision.score.prediction = 2e-4;
  const std::string little = terms_plot(record)->body;  // too low to be seen: said, not drawn
  EXPECT_EQ(little.find("'P, prediction'"), std::string::npos);
  EXPECT_NE(little.find("P ≤ 0.0002'"), std::string::npos);
  for (ViewRecord& view : record.views) view.decision.score.prediction = 0.0;
  EXPECT_NE(terms_plot(record)->body.find("P = 0'"), std::string::npos);
}

TEST(Plots, TheKeyOfTermsStandsInThePicture) {
  const std::string body = terms_plot(scored_record())->body;
  std::map<std::string, std::vector<double>> rows;  // where marks and words begin, by their height
  std::istringstream lines(body);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find(" at screen ");
    if (at == std::string::npos || std::atoi(line.c_str() + 10) < 10) continue;  // no key
    std::istringstream place(line.substr(at + 11));
    double x = 0.0;
    std::string y;
    if (place >> x && place.get() == ',' && place >> y) rows[y].push_back(x);
  }
  ASSERT_GE(rows.size(), 2U);  // phases, terms of the sum
  for (const auto& [y, begins] : rows) {
    EXPECT_EQ(std::adjacent_find(begins.begin(), begins.end(), std::greater_equal<>()),
              begins.end())
        << y;
    EXPECT_GT(begins.front(), 0.0);
    EXPECT_LT(begins.back(), 0.95);
  }
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

/// Eq. (2) as the configuration has it.
TEST(TermsPlot, SaysTheFormulasThatItDraws) {
  RunRecord record = scored_record();
  const std::string body = terms_plot(record)->body;
  for (const char* const formula :
       {"'utility = L Q I exp(−λ d)'", "'Q = (β D + γ P) / (β + γ)'", "'D, density'",
        "'I = 1 + α E, E information gain'", "'exp(−λ d), d distance to the view (m)'",
        "'L = log₁₀ N, N occupied voxels in view'"}) {
    EXPECT_NE(body.find(formula), std::string::npos) << formula;
  }
  record.scenario.planner.utility.normalise_weights = false;
  EXPECT_NE(terms_plot(record)->body.find("'Q = β D + γ P'"), std::string::npos);
}

/// The size cannot be told from the value of a view whose quality is 0: single points remain.
TEST(TermsPlot, PointsShowWhatHasNoNeighbours) {
  RunRecord record = scored_record();
  for (const std::size_t view : {3U, 5U}) {
    record.views[view].decision.score = {.information = 0.02, .distance = 0.9};
  }
  const std::string body = terms_plot(record)->body;
  EXPECT_NE(body.find("'L = log₁₀ N, N occupied voxels (where defined)'"), std::string::npos);
  EXPECT_NE(body.find("$raw using 1:7 with points"), std::string::npos);
}

TEST(TermsPlot, NamesItsMeansWhereItDrawsThem) {
  RunRecord record = scored_record();
  EXPECT_EQ(terms_plot(record)->body.find("'each view'"), std::string::npos);
  while (record.views.size() <= 120) {
    record.views.push_back(record.views.back());
    record.views.back().iteration += 1;
  }
  const Plot plot = *terms_plot(record);
  EXPECT_NE(plot.body.find("'each view'"), std::string::npos);
  EXPECT_NE(plot.body.find("'mean of 15 views'"), std::string::npos);
  expect_drawable(plot);
}

}  // namespace
}  // namespace gnbv
