// Laws of plots: the data in a script are the run's own figures, intervals are Student's, names
// mean nothing to gnuplot, and every format is what its name says.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <sstream>
#include <thread>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tests/support/covered_record.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/plots/coverage_plot.hpp"
#include "tools/plots/density_plot.hpp"
#include "tools/plots/flight_plot.hpp"
#include "tools/plots/forest_plot.hpp"
#include "tools/plots/predictions_plot.hpp"
#include "tools/plots/reach_plot.hpp"
#include "tools/plots/run_plots.hpp"
#include "tools/plots/script_parts.hpp"
#include "tools/plots/tracking_plot.hpp"
#include "tools/run_files/predictions_csv.hpp"

namespace gnbv {
namespace {

/// The rows of a data block of a script.
std::vector<std::vector<double>> block(const std::string& script, const std::string& name) {
  std::istringstream text(script.substr(script.find("$" + name + " << EOD\n")));
  std::vector<std::vector<double>> rows;
  std::string line;
  std::getline(text, line);
  while (std::getline(text, line) && line != "EOD") {
    std::istringstream numbers(line);
    rows.emplace_back();
    for (double value = 0.0; numbers >> value;) rows.back().push_back(value);
  }
  return rows;
}

/// Twelve views by Eq. (2), those from 4 to 6 and the last from frontiers.
RunRecord scored_record() {
  RunRecord record = made_record();
  record.views.clear();
  for (int i = 0; i < 12; ++i) {
    ViewRecord view{.iteration = i};
    view.entropy_nat = 900.0 - 7.3 * i;
    view.density_points_per_voxel = 10.0 + 0.7 * i;
    view.decision.sampler = (i >= 4 && i <= 6) || i == 11 ? "fvs" : i == 0 ? "start" : "agvs";
    Score& s = view.decision.score;
    s = {.value = 0.0, .information = 0.01 * i, .density = 0.8, .prediction = 0.3, .distance = 0.9};
    if (i > 0) s.value = (1.0 + 10.0 * s.information) * 0.55 * 0.9 * std::log10(50.0 + i);
    record.views.push_back(view);
  }
  return record;
}

RunGroup group_of(const std::vector<RunRecord>& runs) {
  RunGroup group{.label = "some", .runs = {}};
  for (const RunRecord& run : runs) group.runs.push_back(&run);
  return group;
}

TEST(Plots, DensityAndEntropyAreTheRunsFigures) {
  const RunRecord record = scored_record();
  const auto rows = block(density_entropy_plot(record)->body, "views");
  ASSERT_EQ(rows.size(), record.views.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i], (std::vector<double>{static_cast<double>(i), record.views[i].entropy_nat,
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
  EXPECT_NE(body.find("rectangle from 3.5,graph 0 to 6.5,graph 1"), std::string::npos);
  EXPECT_NE(body.find("rectangle from 10.5,graph 0 to 11.5,graph 1"), std::string::npos);
}

/// The factors that are drawn multiply to the utility, and the start, which nobody scored, is out.
TEST(Plots, TermsMultiplyToTheUtility) {
  const auto rows = block(terms_plot(scored_record())->body, "raw");
  ASSERT_EQ(rows.size(), 11U);
  for (const auto& row : rows) {
    EXPECT_NEAR(row[1], (row[2] + row[3]) * row[4] * row[5] * row[6], 1e-9);
    EXPECT_NEAR(row[6], std::log10(50.0 + row[0]), 1e-9);
    EXPECT_NEAR(row[2], 0.4, 1e-12);
    EXPECT_NEAR(row[3], 0.15, 1e-12);
  }
  RunRecord unscored = made_record();
  EXPECT_FALSE(terms_plot(unscored).has_value());
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
  for (const double high : {0.5, 9000.0}) {
    EXPECT_NE(y_axis(0.0, high).find("set format y '% h'"), std::string::npos) << high;
  }
  EXPECT_NE(y_axis(123'456.0, 123'460.0).find("set format y '% h'"), std::string::npos);
}

TEST(Plots, MovingMeansShrinkAtTheEnds) {
  const std::vector<double> values = {1, 2, 4, 8, 16};
  EXPECT_EQ(moving_mean(values, 3), (std::vector<double>{1, 7.0 / 3, 14.0 / 3, 28.0 / 3, 16}));
  EXPECT_EQ(moving_mean(values, 1), values);
}

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

/// A key hides no curve: it stands in the corner where that is free, and over the plot where a
/// curve runs through it or a name is too long for it.
TEST(Plots, TheKeyOfCoverageStandsWhereNothingIs) {
  const auto has_key_inside = [](const std::vector<double>& coverage, const std::string& label) {
    const std::vector<RunRecord> runs = {covered_record(1, coverage)};
    const RunGroup group{.label = label, .runs = {&runs[0]}};
    const std::string body = coverage_plot({&group, 1}, Effort::views, 0).body;
    return body.find("set key inside bottom right") != std::string::npos;
  };
  EXPECT_TRUE(has_key_inside({0.6, 0.7, 0.8, 0.9}, "isler"));
  EXPECT_FALSE(has_key_inside({0.0, 0.01, 0.02, 0.03}, "isler"));
  EXPECT_FALSE(has_key_inside({0.6, 0.7, 0.8, 0.9}, std::string(60, 'i')));
}

TEST(Plots, DensitiesOfSeveralRunsLieOverEachOther) {
  const std::vector<RunRecord> runs = {scored_record(), scored_record()};
  const std::vector<RunGroup> groups = {{.label = "a", .runs = {&runs[0]}},
                                        {.label = "b", .runs = {&runs[1]}}};
  const std::string body = mean_density_plot(mean_densities(groups)).body;
  for (const char* const name : {"series0", "series1"}) {
    const auto rows = block(body, name);
    ASSERT_EQ(rows.size(), runs[0].views.size());
    EXPECT_EQ(rows[3][1], runs[0].views[3].density_points_per_voxel);
  }
}

TEST(Plots, CoverageMarksEndsAndTheCeiling) {
  std::vector<RunRecord> runs = {covered_record(1, {0.2, 0.4, 0.5})};
  const RunGroup group = group_of(runs);
  const std::string without = coverage_plot({&group, 1}, Effort::metres, 0).body;
  EXPECT_EQ(block(without, "end0"), (std::vector<std::vector<double>>{{4, 50, 50, 50}}));
  EXPECT_EQ(without.find("'ceiling'"), std::string::npos);
  EXPECT_NE(without.find("'Smoke'"), std::string::npos);
  runs[0].figures->ceiling = 0.975;
  const std::string with = coverage_plot({&group, 1}, Effort::metres, 0).body;
  EXPECT_NE(with.find("97.5 with lines"), std::string::npos);
  EXPECT_NE(with.find("'ceiling'"), std::string::npos);
  const auto end = coverage_end_plot({&group, 1}, Effort::metres, 0);
  ASSERT_TRUE(end.has_value());
  EXPECT_NE(end->body.find("set xrange [3.4:4.04]"), std::string::npos);
  const TempFolder temp;
  EXPECT_NO_THROW(draw_plot(plot_script(*end, PlotFormat::svg, {}), temp.path() / "end.svg"));
}

TEST(Plots, TermsNameNoPredictionWhereThereIsNone) {
  RunRecord record = scored_record();
  EXPECT_NE(terms_plot(record)->body.find("γ prediction"), std::string::npos);
  for (ViewRecord& view : record.views) view.decision.score.prediction = 0.0;
  EXPECT_EQ(terms_plot(record)->body.find("γ prediction"), std::string::npos);
}

/// Flown along x at 8 m a second, then turned back: speeds are those of the path.
TEST(Plots, FlightIsThatOfThePath) {
  const auto plot = flight_plot(made_record());
  ASSERT_TRUE(plot.has_value());
  const auto rows = block(plot->body, "samples");
  ASSERT_EQ(rows.size(), 2U);  // from the first view, at 3 s, to the last sample
  EXPECT_EQ(rows[1][0], 4.0);
  EXPECT_EQ(rows[1][2], -4.0);
  EXPECT_NEAR(rows[1][7], std::sqrt(65.0), 1e-9);
  EXPECT_EQ(rows[1][6], 0.0);
  const TempFolder temp;
  EXPECT_NO_THROW(draw_plot(plot_script(*plot, PlotFormat::svg, {}), temp.path() / "f.svg"));
}

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
  const TempFolder temp;
  EXPECT_NO_THROW(draw_plot(plot_script(*plot, PlotFormat::svg, {}), temp.path() / "f.svg"));
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

TEST(Plots, TextsMeanNothingToGnuplot) {
  EXPECT_EQ(gnuplot_text("it's"), "'it''s'");
  EXPECT_EQ(gnuplot_text("a\nset output \"x\""), "'a set output \"x\"'");
  EXPECT_EQ(gnuplot_text("caf\xc3\xa9 \xff\xc3"), "'caf\xc3\xa9 \xef\xbf\xbd\xef\xbf\xbd'");
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

TEST(Plots, RunsWithoutViewsHaveACoverage) {
  const std::vector<RunRecord> runs = {covered_record(1, {0.2}), covered_record(2, {0.4})};
  for (const Effort effort : {Effort::views, Effort::metres, Effort::seconds}) {
    for (const CoveragePoint& point : mean_coverage(group_of(runs), effort, 0)) {
      EXPECT_EQ(point.effort, 0.0);
      EXPECT_NEAR(point.coverage.mean, 0.3, 1e-12);
    }
  }
}

bool has_gnuplot() {
  try {
    TempFolder temp;
    draw_plot("print 1\n", temp.path() / "any");
    return true;
  } catch (const BadInput&) {
    return false;
  }
}

TEST(Plots, EveryFormatIsWhatItSaysEvenWithHostileNames) {
  if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  TempFolder temp;
  const std::filesystem::path touched = temp.path() / "touched";
  RunRecord record = scored_record();
  record.scenario.name = "a_b^{c} 'q' \"d\" `touch " + touched.string() +
                         "` \\n @x %d $y <b>&amp;\n!touch " + touched.string();
  const std::vector<Plot> plots = {*density_entropy_plot(record), *terms_plot(record)};
  for (const Plot& plot : plots) {
    for (const auto& [format, magic] : {std::pair{PlotFormat::svg, "<?xml"},
                                        {PlotFormat::png, "\x89PNG"},
                                        {PlotFormat::pdf, "%PDF"}}) {
      const std::filesystem::path picture = temp.path() / "picture";
      draw_plot(plot_script(plot, format, {.width_px = 400}), picture);
      const std::string content = read_file(picture);
      EXPECT_TRUE(content.starts_with(magic));
      EXPECT_GT(content.size(), 3000U);
      if (format != PlotFormat::svg) continue;
      EXPECT_NE(content.find("a_b^{c} 'q'"), std::string::npos);  // as it stands, not as markup
      EXPECT_EQ(content.find("<b>"), std::string::npos);
    }
  }
  EXPECT_FALSE(std::filesystem::exists(touched));
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
  if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  TempFolder temp;
  EXPECT_NO_THROW(draw_plot(plot_script(*plot, PlotFormat::svg, {}), temp.path() / "reach.svg"));
}

/// A dot a view and source, what is 0 on the axis's end; shares over all views.
TEST(PredictionsPlot, DotsAndSharesAreTheSumsOfTheFile) {
  TempFolder temp;
  RunRecord record = scored_record();
  record.folder = temp.path();
  EXPECT_FALSE(predictions_plot(record));
  const std::vector<ViewOutcome> outcomes = {
      {1, {PatchSource::sampled, 0, 0, 2, 100.0, 90.0, 40.0}},
      {1, {PatchSource::sampled, 0, 1, 1, 20.0, 15.0, 5.0}},
      {1, {PatchSource::frontier, 4, 0, 1, 10.0, 5.0, 0.0}},
      {3, {PatchSource::sampled, 0, 0, 2, 60.0, 30.0, 40.0}}};
  write_file_atomically(temp.path() / kPredictionsFile, predictions_csv(outcomes));
  const auto plot = predictions_plot(record);
  ASSERT_TRUE(plot.has_value());
  using Rows = std::vector<std::vector<double>>;
  EXPECT_EQ(block(plot->body, "views_sampled_0"), (Rows{{105, 45}, {30, 40}}));
  EXPECT_EQ(block(plot->body, "views_frontier_0"), (Rows{{5, 0.5}}));
  EXPECT_EQ(block(plot->body, "share_sampled_0"), (Rows{{0, 50, 75}}));
  EXPECT_EQ(block(plot->body, "share_sampled_1"), (Rows{{0, 25, 75}}));
  EXPECT_EQ(block(plot->body, "share_frontier_0"), (Rows{{4, 0, 50}}));
  EXPECT_EQ(plot->body.find("opposite"), std::string::npos);  // neither dot nor key
  write_file_atomically(temp.path() / kPredictionsFile, predictions_csv({}));
  EXPECT_FALSE(predictions_plot(record));
  if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  TempFolder drawn;  // has_gnuplot() has cleared away the other one
  EXPECT_NO_THROW(draw_plot(plot_script(*plot, PlotFormat::svg, {}), drawn.path() / "p.svg"));
}

TEST(Plots, OneViewIsEnough) {
  if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  TempFolder temp;
  RunRecord record = scored_record();
  record.views = {record.views[1]};
  record.views[0].density_points_per_voxel = 0.0;
  for (const auto& plot : {density_entropy_plot(record), terms_plot(record)}) {
    ASSERT_TRUE(plot.has_value());
    EXPECT_NO_THROW(draw_plot(plot_script(*plot, PlotFormat::svg, {}), temp.path() / "one.svg"));
  }
  const std::vector<RunRecord> runs = {covered_record(1, {0.2})};
  for (const Effort effort : {Effort::views, Effort::metres, Effort::seconds}) {
    const RunGroup group = group_of(runs);
    const Plot plot = coverage_plot({&group, 1}, effort, 0);
    EXPECT_NO_THROW(draw_plot(plot_script(plot, PlotFormat::svg, {}), temp.path() / "none.svg"));
  }
}

TEST(Plots, APdfDoesNotSayWhenItWasDrawn) {
  if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  TempFolder temp;
  const std::string script =
      plot_script(*density_entropy_plot(scored_record()), PlotFormat::pdf, {.width_px = 400});
  draw_plot(script, temp.path() / "one.pdf");
  const std::string content = read_file(temp.path() / "one.pdf");
  EXPECT_NE(content.find("/CreationDate (D:20000101000000"), std::string::npos);
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  draw_plot(script, temp.path() / "two.pdf");
  EXPECT_EQ(content, read_file(temp.path() / "two.pdf"));
}

TEST(Plots, ARefusedScriptLeavesNothing) {
  if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  TempFolder temp;
  try {
    draw_plot("plot nonsense(\n", temp.path() / "picture.svg");
    FAIL() << "accepted";
  } catch (const BrokenInvariant& error) {
    EXPECT_NE(std::string(error.what()).find("nonsense"), std::string::npos) << error.what();
  }
  EXPECT_TRUE(std::filesystem::is_empty(temp.path()));
}

TEST(TrackingPlot, ShowsTheDistanceFromEachLegAndTheTilt) {
  RunRecord record = made_record();  // views at 3 s (4, 4, 1), 4 s (-4, 4, 2) and 5 s (-4, -4, 3)
  record.views[1].decision.via_world_m = {Vec3(0, 4, 1)};
  TrajectorySample leaning = made_sample(3.5, {2, 4.3, 1.4});  // 0.5 m beside the first leg
  leaning.T_world_body.rotate(Eigen::AngleAxisd(deg_to_rad(12.0), Vec3(0.6, 0.8, 0.0)));
  record.path = {made_sample(2.9, {9, 9, 9}), leaning, made_sample(4.5, {-4, 0, 2.5}),
                 made_sample(5.1, {9, 9, 9})};
  const auto plot = tracking_plot(record);
  ASSERT_TRUE(plot.has_value());
  const auto rows = block(plot->body, "samples");
  ASSERT_EQ(rows.size(), 2U);  // only between the first view and the last
  const std::vector<std::vector<double>> expected = {{3.5, 0.5, 12.0}, {4.5, 0.0, 0.0}};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(rows[i][k], expected[i][k], 1e-6) << i << k;
  }
  // 0.8 m less the hull's 0.384 m
  EXPECT_NE(plot->body.find("plot 0.416 with lines"), std::string::npos);
  record.views.resize(1);
  EXPECT_FALSE(tracking_plot(record).has_value());
}

}  // namespace
}  // namespace gnbv
