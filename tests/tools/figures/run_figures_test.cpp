// Laws of the figures of one run: their data are its own.
#include "tools/figures/run_figures.hpp"

#include <gmock/gmock.h>

#include "sim/core/file.hpp"
#include "tests/support/temp_folder.hpp"
#include "tests/tools/figures/figure_support.hpp"
#include "tools/run/tour_files.hpp"

namespace gnbv {
namespace {

using testing::Contains;
using testing::ElementsAre;
using Values = std::vector<double>;

std::vector<std::string> headings(const Figure& figure) {
  std::vector<std::string> headings;
  for (const FigurePanel& panel : figure.panels) headings.push_back(panel.heading);
  return headings;
}

/// As on the axis of coverage: what was known after the first view stands at 1.
TEST(RunFigures, DensityAndEntropyAreTheRunsFigures) {
  RunRecord record = scored_record();
  const Figure both = *density_entropy_figure(record);
  const Series entropy = series_of(both, "entropy");
  const Series density = series_of(both, "density");
  ASSERT_EQ(entropy.x.size(), record.views.size());
  for (std::size_t i = 0; i < record.views.size(); ++i) {
    EXPECT_EQ(entropy.x[i], static_cast<double>(i + 1));
    EXPECT_EQ(entropy.y[i], record.views[i].entropy_nat);
    EXPECT_EQ(density.y[i], record.views[i].density_points_per_voxel);
  }
  EXPECT_THAT(both.panels[0].shades.spans,
              ElementsAre(std::array{4.5, 7.5}, std::array{11.5, 12.5}));
  EXPECT_THAT(headings(both), ElementsAre("entropy (nat), axis cut", "density (points/voxel)"));
  record.views.back().entropy_nat = 3.0;
  // where a figure of all runs has the densities
  const Figure alone = *density_entropy_figure(record, false);
  EXPECT_EQ(alone.name, "entropy");
  EXPECT_THAT(headings(alone), ElementsAre("entropy (nat)"));
}

/// The factors that are drawn multiply to the utility, and the start, which nobody scored, is out.
TEST(RunFigures, TermsMultiplyToTheUtility) {
  RunRecord record = scored_record();
  const Figure figure = *terms_figure(record);
  const auto of = [&](const char* name) { return series_of(figure, name).y; };
  ASSERT_EQ(of("utility").size(), 11U);
  for (std::size_t i = 0; i < 11; ++i) {
    const double quality = series_of(figure, "P, prediction").high[i];
    EXPECT_NEAR(of("utility")[i], quality * of("I")[i] * of("exp(−λ d)")[i] * of("L")[i], 1e-9);
    EXPECT_NEAR(of("L")[i], std::log10(51.0 + static_cast<double>(i)), 1e-9);
    EXPECT_NEAR(of("D, density")[i], 0.4, 1e-12);
    EXPECT_NEAR(quality, 0.55, 1e-12);
  }
  EXPECT_THAT(
      headings(figure),
      ElementsAre("utility = L Q I exp(−λ d)", "Q = (β D + γ P) / (β + γ)",
                  "I = 1 + α E, E information gain", "exp(−λ d), d distance to the view (m)",
                  "L = log₁₀ N, N occupied voxels in view"));
  record.scenario.planner.utility.normalise_weights = false;
  EXPECT_EQ(headings(*terms_figure(record))[1], "Q = β D + γ P");
  record.scenario.planner.utility.name = "bircher";
  EXPECT_THAT(headings(*terms_figure(record)),
              ElementsAre("utility", "the product of gain", "and distance factor"));
  EXPECT_FALSE(terms_figure(made_record()).has_value());
}

/// A view may be chosen for want of a better one: its value of 0 is drawn, not bridged, and the
/// size, which cannot be told from it, is not known.
TEST(RunFigures, TermsOfWorthlessViewsAreDrawn) {
  RunRecord record = scored_record();
  record.views[5].decision.score = {.information = 0.02, .distance = 0.9};
  const Figure figure = *terms_figure(record);
  EXPECT_EQ(series_of(figure, "utility").x[4], 6.0);
  EXPECT_EQ(series_of(figure, "utility").y[4], 0.0);
  EXPECT_TRUE(std::isnan(series_of(figure, "L").y[4]));
  EXPECT_EQ(headings(figure).back(), "L = log₁₀ N, N occupied voxels (where defined)");
  EXPECT_EQ(series_of(figure, "L, each view").mark, Mark::points);
}

TEST(RunFigures, TermsNameNoPredictionWhereThereIsNone) {
  RunRecord record = scored_record();
  EXPECT_THAT(labels_in(*terms_figure(record)), Contains("P, prediction"));
  for (const auto& [prediction, words] : {std::pair{2e-4, ", P ≤ 0.0002"}, {0.0, ", P = 0"}}) {
    for (ViewRecord& view : record.views) view.decision.score.prediction = prediction;
    const Figure figure = *terms_figure(record);  // too low to be seen: said, not drawn
    EXPECT_THAT(labels_in(figure), ElementsAre("D, density"));
    EXPECT_THAT(headings(figure)[1], testing::HasSubstr(words));
  }
}

TEST(RunFigures, TermsOfManyViewsAreMeansBesideEachView) {
  RunRecord record = scored_record();
  EXPECT_TRUE(terms_figure(record)->notes.empty());
  while (record.views.size() <= 120) {
    record.views.push_back(record.views.back());
    record.views.back().iteration += 1;
  }
  const Figure figure = *terms_figure(record);
  EXPECT_THAT(figure.notes, ElementsAre("thin: each view; thick: mean of 15 views"));
  EXPECT_EQ(series_of(figure, "I").y, moving_mean(series_of(figure, "I, each view").y, 15));
}

TEST(RunFigures, OneViewIsEnough) {
  RunRecord record = scored_record();
  record.views = {record.views[1]};
  record.views[0].density_points_per_voxel = 0.0;
  for (const auto& figure : {density_entropy_figure(record), terms_figure(record)}) {
    ASSERT_TRUE(figure.has_value());
    for (const FigurePanel& panel : figure->panels) {
      EXPECT_LT(panel.x.low, panel.x.high);
      EXPECT_LT(panel.y.low, panel.y.high);
    }
  }
}

/// A dot a view and source, what is 0 on the axis's end; shares over all views.
TEST(RunFigures, PredictionsAreTheSumsOfTheFile) {
  const TempFolder temp;
  RunRecord record = scored_record();
  record.folder = temp.path();
  EXPECT_FALSE(predictions_figure(record));
  const std::vector<ViewOutcome> outcomes = {
      {1, {PatchSource::sampled, 0, 0, 2, 100.0, 90.0, 40.0}},
      {1, {PatchSource::sampled, 0, 1, 1, 20.0, 15.0, 5.0}},
      {1, {PatchSource::boundary, 4, 0, 1, 10.0, 5.0, 0.0}},
      {3, {PatchSource::sampled, 0, 0, 2, 60.0, 30.0, 40.0}}};
  write_file_atomically(temp.path() / kPredictionsFile, predictions_csv(outcomes));
  const Figure figure = *predictions_figure(record);
  EXPECT_EQ(series_of(figure, "sampled").x, (Values{105, 30}));
  EXPECT_EQ(series_of(figure, "sampled").y, (Values{45, 40}));
  EXPECT_EQ(series_of(figure, "frontier").y, Values{0.5});
  EXPECT_EQ(figure.panels[0].y.ticks.front().text, "0");
  const auto share = [&](std::size_t panel, const char* name) {
    return series_of({.name = "", .kind = "", .panels = {figure.panels.at(panel)}}, name).y;
  };
  EXPECT_EQ(share(1, "sampled, found"), Values{50});
  EXPECT_EQ(share(1, "sampled, promised"), Values{75});
  EXPECT_EQ(share(2, "sampled, found"), Values{25});
  EXPECT_EQ(share(1, "frontier, promised"), Values{50});
  EXPECT_THAT(labels_in(figure),
              ElementsAre("sampled", "frontier"));  // no source that is not there
  write_file_atomically(temp.path() / kPredictionsFile, predictions_csv({}));
  EXPECT_FALSE(predictions_figure(record));
}

}  // namespace
}  // namespace gnbv
